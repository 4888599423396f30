// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A pair of pictures of one pose, laser off and on -> the laser's light alone.
#pragma once

#include "core/image.h"

namespace lightstripe {

/// How the ambient light of the `laser` picture follows from the `board` picture: grey level = gain * board +
/// offset.
struct AmbientChange {
  double gain = 1;
  double offset = 0;
};

/// The pair may differ in exposure or lamp: gain and offset are fitted to the medians of the laser picture at
/// each grey level of the board picture, which the few pixels under the stripe do not move. A board picture
/// without contrast keeps gain 1.
AmbientChange fit_ambient_change(ImageView8 laser, ImageView8 board);

/// Grey level of no laser light in laser_light(): several times the noise, whose lower half would be clipped
/// at 0, so that it passed for little noise and its peaks for light.
inline constexpr int kDarkLevel = 12;

/// kDarkLevel + laser - (gain * board + offset), clipped to 0..255. Both pictures of one size.
Image8 laser_light(ImageView8 laser, ImageView8 board);

}  // namespace lightstripe
