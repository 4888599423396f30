// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A picture of what was found, for people to judge.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/stripe.h"

namespace lightstripe {

struct OverlayOptions {
  int zoom = 1;             ///< each pixel becomes zoom x zoom
  double brightness = 1.0;  ///< the grey picture's, 0..1: darker lets the lines stand out
};

/// Interleaved RGB of (width * zoom) x (height * zoom): the grey picture, on it each stripe in its own
/// colour, thin and anti-aliased through the sub-pixel points; bridged points are drawn as small rings, the
/// line's number stands at its first point. Points farther apart than a few pixels are not joined.
std::vector<std::uint8_t> draw_overlay(ImageView8 image, const std::vector<Stripe>& stripes,
                                       const OverlayOptions& options = {});

/// Draws the same into an interleaved RGB picture of width * height * 3 bytes.
void draw_stripes(std::vector<std::uint8_t>& rgb, int width, int height, const std::vector<Stripe>& stripes);

}  // namespace lightstripe
