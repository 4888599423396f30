// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What a user may choose about the extraction: the only place where its options and their defaults are
// written.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "core/fields.h"
#include "extraction/lines/line_filter_options.h"

namespace lightstripe {

enum class ExtractionMethod { kDirectionGuided, kSteger, kZhouRoi, kHuRecursive, kCentroid, kExtremum };

constexpr std::array<EnumName<ExtractionMethod>, 6> enum_names(ExtractionMethod) {
  return {{{ExtractionMethod::kDirectionGuided, "direction-guided"},
           {ExtractionMethod::kSteger, "steger"},
           {ExtractionMethod::kZhouRoi, "zhou-roi"},
           {ExtractionMethod::kHuRecursive, "hu-recursive"},
           {ExtractionMethod::kCentroid, "centroid"},
           {ExtractionMethod::kExtremum, "extremum"}}};
}

/// Whether the lines are brighter or darker than their surroundings.
enum class Polarity { kBright, kDark };

constexpr std::array<EnumName<Polarity>, 2> enum_names(Polarity) {
  return {{{Polarity::kBright, "bright"}, {Polarity::kDark, "dark"}}};
}

/// Whether points move onto a curve through their neighbours along the line.
enum class Smoothing { kNever, kInGrain, kAlways };

constexpr std::array<EnumName<Smoothing>, 3> enum_names(Smoothing) {
  return {{{Smoothing::kNever, "false"}, {Smoothing::kInGrain, "auto"}, {Smoothing::kAlways, "true"}}};
}

struct ExtractionOptions {
  ExtractionMethod method = ExtractionMethod::kDirectionGuided;
  Polarity polarity = Polarity::kBright;
  std::optional<double> stripe_width;  ///< px, full width 2w of the bright bar; sigma = w / sqrt(3)
  std::optional<double> sigma;         ///< px; neither given: the width is estimated from the image
  std::string thresholds = "auto";     ///< auto = bilevel, otsu, rosin, or "LOW,HIGH" in grey levels
  std::optional<double> alpha;         ///< weight of T_min in T_l, [0, 1]; not given: from entropy and peaks
  double beta = 0;                     ///< weight of T_max in T_h, [0, 1]
  std::string roi = "all";             ///< "X,Y,WIDTH,HEIGHT": only this part of the image, px
  std::string start = "none";          ///< "X,Y": the line nearest to this place is followed first, px
  int stop_after = 0;                  ///< no further line is looked for after so many; 0 = all
  int max_lines = 0;                   ///< only the longest lines; 0 = all
  bool curvature_correction = true;    ///< undo the kernels' drift to the inner side of bends
  bool track = false;                  ///< in sequences: look near the lines of an earlier frame first
  Smoothing smoothing = Smoothing::kNever;  ///< a curve whose bend changes little, along the lines
  LineFilterOptions lines;                  ///< what a line has to be like
  /// No option of files: the light lies on a printed pattern, which varies it along the line as coarse grain
  /// would.
  bool on_pattern = false;
};

template <class V>
void visit_fields(V&& v, ExtractionOptions& o) {
  v("method", o.method, "direction-guided | steger | zhou-roi | hu-recursive | centroid | extremum");
  v("polarity", o.polarity,
    "bright | dark: whether the lines are brighter or darker than what is beside them");
  v("stripe_width", o.stripe_width, "full width of the bright bar, px; default: estimated from the image");
  v("sigma", o.sigma, "scale of the Gaussian kernels, px; default: stripe_width / (2 sqrt 3)");
  v("thresholds", o.thresholds, "auto (bilevel), otsu, rosin, or LOW,HIGH in grey levels");
  v("alpha", o.alpha, "weight of the background's grey level in the low threshold; default: automatic");
  v("beta", o.beta, "weight of the brightest grey level in the high threshold");
  v("roi", o.roi, "all, or X,Y,WIDTH,HEIGHT: only this part of the image, px");
  v("start", o.start, "none, or X,Y: the line nearest to this place is followed first, px");
  v("stop_after", o.stop_after, "no further line is looked for after so many (direction-guided); 0 = all");
  v("max_lines", o.max_lines, "only the longest lines; 0 = all");
  v("curvature_correction", o.curvature_correction, "undo the kernels' drift to the inner side of bends");
  v("track", o.track,
    "sequences: look near an earlier frame's lines and coarsely over the rest; where a line is lost "
    "everywhere");
  v("smoothing", o.smoothing,
    "false | auto | true: points move onto a curve along their line, whose bend changes as little as they "
    "allow; auto: where the light has grain");
  v("lines", o.lines);
}

/// Where scans and live profiles begin. Their neighbours share errors after smoothing, which a calibration,
/// that weighs many points, would have to know; a profile is looked at as it is.
inline ExtractionOptions scan_extraction() {
  ExtractionOptions options;
  options.smoothing = Smoothing::kInGrain;
  return options;
}

}  // namespace lightstripe
