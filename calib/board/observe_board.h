// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Images -> observations: a board's corners and the stripe's points on it.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "core/board.h"
#include "core/image.h"
#include "core/stripe.h"
#include "extraction/extract_stripes.h"

namespace lightstripe {

struct BoardDetection {
  bool found = false;
  std::string reason;  ///< why not, in words a person can act on
  std::vector<Eigen::Vector2d>
      corners;              ///< px, in the order of Target::corner, handedness and colours checked
  std::size_t image = 0;    ///< which of the candidate images showed it
  bool board_like = false;  ///< not found, but something like it is in view
  int seen_columns = 0, seen_rows = 0;  ///< not found: size of the largest grid of squares in view
  double circle_mm = 0;                 ///< circles: their diameter as seen
};

/// The board's corners to a few hundredths of a pixel: located by linking saddle points to grids, or where
/// that fails by cv::findChessboardCornersSB; refined by cv::cornerSubPix. The order is made unique: x cross
/// y points into the board, and the square between the first four corners is dark where the target's colours
/// can tell (columns + rows odd). A corner that the refinement leads far astray, as a laser line over it
/// does, is unseen. Thread-safe.
BoardDetection detect_board(ImageView8 image, const Target& target);

/// The first of several renderings of one picture that shows the board; of a colour picture with a laser line
/// give first the channels in which the line is weakest (red laser: green, blue), then the grey picture. No
/// candidates: not found.
BoardDetection detect_board(std::span<const ImageView8> candidates, const Target& target);

struct StripeOnBoard {
  std::vector<std::vector<StripePoint>> planes;  ///< for each laser plane, points on the board
  std::string reason;  ///< why there are none, or too few of them; empty if all is well
};

/// The stripe's points on the board: `laser` shows the stripe; `board` (may be empty) shows the same pose
/// with the laser off and is subtracted. Points near the squares' edges, where the albedo step shifts the
/// centre, are left out.
StripeOnBoard find_stripe_on_board(ImageView8 laser, ImageView8 board,
                                   const std::vector<Eigen::Vector2d>& corners, const Target& target,
                                   int laser_planes, const ExtractionOptions& extraction);

/// The same in a picture of the laser's light alone, whose background is taken out already.
StripeOnBoard find_stripe_in_light(ImageView8 light, const std::vector<Eigen::Vector2d>& corners,
                                   const Target& target, int laser_planes,
                                   const ExtractionOptions& extraction);

/// The second half of find_stripe_on_board: of the stripes found in the whole picture the points on the
/// board, as `laser_planes` straight lines on it, ordered by their place across the image (left to right, or
/// top to bottom).
StripeOnBoard select_stripes(const std::vector<Stripe>& stripes, const std::vector<Eigen::Vector2d>& corners,
                             const Target& target, int laser_planes);

}  // namespace lightstripe
