// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Images -> observations: checkerboard corners and the stripe's points on the board.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/board.h"
#include "core/image.h"
#include "core/stripe.h"
#include "extraction/extract_stripes.h"

namespace lightstripe {

struct BoardDetection {
  bool found = false;
  std::string reason;                    ///< why not, in words a person can act on
  std::vector<Eigen::Vector2d> corners;  ///< px, in the order of Target::corner, handedness and colours checked
};

/// cv::findChessboardCornersSB; the order is made unique: x cross y points into the board, and the square between the
/// first four corners is dark where the target's colours can tell (columns + rows odd).
BoardDetection detect_board(ImageView8 image, const Target& target);

struct StripeOnBoard {
  std::vector<std::vector<StripePoint>> planes;  ///< for each laser plane, points on the board
  std::string reason;                            ///< why there are none
};

/// The stripe's points on the board: `laser` shows the stripe; `board` (may be empty) shows the same pose with the laser off
/// and is subtracted. Points near the squares' edges, where the albedo step shifts the centre, are left out.
StripeOnBoard find_stripe_on_board(ImageView8 laser, ImageView8 board, const std::vector<Eigen::Vector2d>& corners,
                                   const Target& target, int laser_planes, const ExtractionOptions& extraction);

}  // namespace lightstripe
