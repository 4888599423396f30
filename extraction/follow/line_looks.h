// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// How a line just followed looks: what decides its scale and whether the search is in vain.
#pragma once

#include <cstdint>
#include <span>

#include "core/image.h"
#include "core/stripe.h"
#include "extraction/follow/exclusion_mask.h"
#include "extraction/follow/follow_tuning.h"

namespace lightstripe {

/// A good part of the points lies on pixels of at least `level`, grey levels.
template <class T>
bool is_clipped(ImageView<T> image, std::span<const StripePoint> points, double level);

/// The light falls on one side only. The filter drops such a line later, by its own profiles; here it tells
/// how much of the search is in vain. `sigma`: of the kernels, px.
template <class T>
bool is_edge(ImageView<T> image, std::span<const StripePoint> points, double sigma);

/// In the glow of a line that is already found broad kernels see it once more: more than the share `most` of
/// what they look at belongs to other lines. `first_label`: of this line, in the mask.
template <class T>
bool runs_beside_another(ImageView<T> image, const ExclusionMask& mask, std::span<const StripePoint> points,
                         double sigma, std::uint16_t first_label, double most);

/// Of the points' strengths.
double mean_strength(std::span<const StripePoint> points);

/// Times the scale that a line's width asks for, by the grain of its strength. A kernel of the stripe's own
/// width is best in the camera's noise, which it takes in from beside the stripe; the grain of speckle is in
/// the stripe's own light, and the more of it a kernel averages the better.
double broader_in_grain(const FollowTuning& tuning, double grain);

}  // namespace lightstripe
