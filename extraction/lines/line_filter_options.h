// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What a line has to be like to be kept.
#pragma once

#include "core/fields.h"

namespace lightstripe {

struct LineFilterOptions {
  double min_length = 5.0;           ///< shortest line, in full stripe widths
  double min_contrast = 0.06;        ///< weakest line, as a share of the brightest line's intensity
  double clear_contrast = 0.4;       ///< below this share a line must also be regular and of the usual width
  double min_contrast_to_noise = 3;  ///< weakest line: median contrast over the image noise
  double max_width_ratio = 2.0;      ///< a line's width against the stripes' width, and the other way round
  double spot_width_ratio = 1.5;  ///< a stretch so much wider than its line is a bright spot, not the stripe
  int max_spot_widths = 10;       ///< longest spot that is bridged, in full stripe widths
};

template <class V>
void visit_fields(V&& v, LineFilterOptions& o) {
  v("min_length", o.min_length, "shortest line, in full stripe widths");
  v("min_contrast", o.min_contrast, "weakest line, as a share of the brightest line's intensity");
  v("clear_contrast", o.clear_contrast,
    "weaker lines than this share must be as regular and as wide as the others");
  v("min_contrast_to_noise", o.min_contrast_to_noise, "weakest line's contrast over the image noise");
  v("max_width_ratio", o.max_width_ratio, "largest ratio of a line's width to the stripes' width");
  v("spot_width_ratio", o.spot_width_ratio, "a stretch wider than its line by this ratio is a bright spot");
  v("max_spot_widths", o.max_spot_widths, "longest spot that is bridged, in full stripe widths");
}

}  // namespace lightstripe
