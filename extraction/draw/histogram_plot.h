// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A picture of the grey levels and of where the thresholds stand among them.
#pragma once

#include <cstdint>
#include <vector>

#include "extraction/image/thresholds.h"
#include "extraction/result.h"

namespace lightstripe {

inline constexpr int kHistogramPlotWidth = 840, kHistogramPlotHeight = 420;  ///< px

/// Interleaved RGB: counts on a logarithmic scale over the grey levels; T_min, T_rosin, T_otsu and T_max as
/// thin lines, the thresholds in force, T_l and T_h, as thick ones.
std::vector<std::uint8_t> draw_histogram(const Histogram& histogram, const ExtractionResult& result);

}  // namespace lightstripe
