// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The extraction's options checked, and those that are text read.
#pragma once

#include <optional>

#include "extraction/options.h"

namespace lightstripe {

struct LevelPair {
  double low = 0, high = 0;  ///< grey levels
};
struct PixelRectangle {
  int x = 0, y = 0, width = 0, height = 0;
};
struct PixelPlace {
  double x = 0, y = 0;
};

enum class ThresholdRule { kBilevel, kOtsu, kRosin, kGiven };

struct ParsedOptions {
  ThresholdRule rule = ThresholdRule::kBilevel;
  LevelPair given;  ///< with kGiven
  std::optional<PixelRectangle> roi;
  std::optional<PixelPlace> start;
};

/// Error naming the option that is out of its range.
ParsedOptions parse_options(const ExtractionOptions& options);

inline constexpr double kLeastSigma = 0.7;  ///< px; below it the pixels no longer carry the derivatives
inline constexpr double kLargestSigma = 20;

}  // namespace lightstripe
