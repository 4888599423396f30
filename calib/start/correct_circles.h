// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A disc's picture is not centred at the picture of the disc's middle.
#pragma once

#include "calib/start/initial_values.h"

namespace lightstripe {

/// Centre of gravity of the picture of a disc on the board, less the picture of its middle, px: what
/// perspective and distortion add. Integrated over the disc (three rings of twelve samples); zero where a
/// part of it is not in front of the camera.
Eigen::Vector2d disc_bias_px(const Camera& camera, const Rigid3& cam_from_board,
                             const Eigen::Vector2d& middle, double diameter_mm);

/// Takes the bias out of all views' corners, with the cameras and poses known so far.
void correct_circles(InitialValues& values);

}  // namespace lightstripe
