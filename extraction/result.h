// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What the extraction finds in one image.
#pragma once

#include <vector>

#include "core/stripe.h"
#include "extraction/image/impression.h"
#include "extraction/image/thresholds.h"

namespace lightstripe {

/// The stripes are ordered by falling length; each runs with growing x or y, whichever spans more.
struct ExtractionResult {
  std::vector<Stripe> stripes;
  double sigma = 0;          ///< the scale used, px
  double threshold_low = 0;  ///< grey levels
  double threshold_high = 0;
  double noise = 0;  ///< standard deviation of the image noise, grey levels, measured in the image
  Impression impression = Impression::kNone;  ///< of a picture without stripes
  BilevelThresholds levels;                   ///< how automatic thresholds come about in this image
};

}  // namespace lightstripe
