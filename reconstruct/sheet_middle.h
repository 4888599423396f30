// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A laser sheet is some tenths of a mm thick. Where a camera looks along it obliquely to the line, each place
// of the picture shows light of the sheet's near and far side from different places along the line: where
// the line bends, or its light fades, the middle of the stripe is not the sheet's middle.
#pragma once

#include <span>
#include <vector>

#include "core/camera.h"
#include "core/plane.h"
#include "core/stripe.h"

namespace lightstripe {

struct SheetShift {
  double px = 0;    ///< along the point's normal
  double told = 0;  ///< 0 to 1: how far the line tells the sheet here
};

/// How far each point of one line has to move to lie in the sheet's middle; `shifts` becomes as long as the
/// line. The sheet's light is a Gaussian of the variance s^2 px^2 along the direction
/// d of the plane's normal in the picture, and the body goes on along that normal as it is (a rail, a wheel;
/// of any other body nothing better is known). With the line's tangent t, normal n, curvature vector k and
/// the slope g of the logarithm of its strength, the stripe's middle lies off by
///   s^2 (-(d.t) (d.n) g + (d.t)^2 (k.n) / 2),
/// the first moment of the light to the second order of the sheet's thickness. s comes from the line's widths
/// less what lens and pixels add. 0 near the line's ends, where the kernels see them, beside gaps, bridges
/// and clipped places, and where the sheet is seen edge-on.
void find_sheet_shifts(const Camera& camera, const Plane& plane, std::span<const StripePoint> line,
                       std::vector<SheetShift>& shifts);

/// The point in the sheet's middle. Its sigma_px loses most of what fading light may do to it: what of that
/// comes from the sheet is undone, a stain's oblique border is left.
StripePoint in_sheet_middle(const StripePoint& p, const SheetShift& shift);

}  // namespace lightstripe
