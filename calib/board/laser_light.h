// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A pair of pictures of one pose of the board, laser off and on -> the laser's light alone.
#pragma once

#include "extraction/image/background.h"

namespace lightstripe {

/// kDarkLevel + laser - (gain * board + offset), clipped to 0..255, by fit_ambient_change(). Both pictures of
/// one size.
Image8 laser_light(ImageView8 laser, ImageView8 board);

}  // namespace lightstripe
