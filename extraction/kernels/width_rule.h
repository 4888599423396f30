// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Steger's rule between the scale of the kernels and the width of the stripes they are made for: a flat bar
// of half width w has one ridge in its middle only from sigma = w / sqrt(3) on.
#pragma once

#include <numbers>

namespace lightstripe {

/// Full width 2w of the bright bar that kernels of scale `sigma` are made for, px.
constexpr double full_width_of(double sigma) { return 2 * std::numbers::sqrt3 * sigma; }
constexpr double sigma_of_full_width(double width) { return width / (2 * std::numbers::sqrt3); }

}  // namespace lightstripe
