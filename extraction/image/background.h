// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A picture with the laser and one without -> the laser's light alone. The difference has the noise of both
// pictures, and as the noise is measured in the picture that is looked at, sigma_px counts both.
#pragma once

#include "core/image.h"

namespace lightstripe {

/// How the ambient light of the lit picture follows from the dark one: grey level = gain * dark + offset.
struct AmbientChange {
  double gain = 1;
  double offset = 0;  ///< grey levels
};

/// The pair may differ in exposure or lamp: gain and offset are fitted to the medians of the lit picture at
/// each grey level of the dark one, which the few pixels under the stripe do not move. A dark picture without
/// contrast keeps gain 1. Pictures of 16 bits are looked at in 256 levels.
AmbientChange fit_ambient_change(ImageView8 lit, ImageView8 dark);
AmbientChange fit_ambient_change(ImageView16 lit, ImageView16 dark);

/// Grey level of no laser light, of 256: several times the noise, whose lower half would be clipped at 0, so
/// that it passed for little noise and its peaks for light.
inline constexpr int kDarkLevel = 12;

/// kDarkLevel + lit - (gain * dark + offset), rounded, clipped to 0..255. Both pictures of one size.
Image8 laser_light(ImageView8 lit, ImageView8 dark);

template <class T>
struct LaserLight {
  Image<T> image;  ///< as laser_light(); `where` is always known
  AmbientChange change;
  double darker_share = 0;  ///< of the pixels: clearly darker than without the laser, which only adds light
};

/// Both pictures of one size. `where` of the lit picture stays; a grey picture gets one that is sure
/// everywhere, since what is not laser is gone.
template <class T>
LaserLight<T> subtract_background(const Image<T>& lit, const Image<T>& dark);

}  // namespace lightstripe
