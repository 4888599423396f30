// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What extraction makes of an image: the centre lines of the light stripes.
#pragma once

#include <cstdint>
#include <vector>

namespace lightstripe {

/// What is special about a stripe point; bits of StripePoint::flags.
enum StripeFlag : std::uint8_t {
  kStripeBridged = 1,  ///< placed across a gap or a crossing, not measured at a ridge of its own
  kStripeSaturated =
      2,  ///< the stripe's top is clipped here: its centre is less sure than sigma_px of an unclipped one
  kStripeAsymmetric = 4,  ///< the two flanks differ: the centre may be shifted
};

/// One sub-pixel centre point of a stripe.
struct StripePoint {
  double x = 0;         ///< px, (0, 0) = centre of the top-left pixel
  double y = 0;         ///< px
  double normal_x = 0;  ///< unit vector across the line
  double normal_y = 0;
  double width = 0;     ///< px, full width 2w of the bright bar
  double strength = 0;  ///< grey levels / px^2: minus the second derivative across the line at scale sigma
  double sigma_px = 0;  ///< predicted 1-sigma error across the line, px
  float intensity = 0;  ///< peak grey level above the background
  float fade_px = 0;    ///< the part of sigma_px that fading light may have: who knows the sheet knows better
  std::uint8_t flags = 0;  ///< StripeFlag bits
};

/// One light stripe: its centre points in order along the line.
struct Stripe {
  std::vector<StripePoint> points;
};

}  // namespace lightstripe
