// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Pixels to board coordinates without a camera model, from one view's corners.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/board.h"

namespace lightstripe {

/// Homography plus a cubic polynomial of the pixel for what lens distortion adds; good within the corners and
/// about a square beyond.
struct BoardMap {
  Eigen::Matrix3d board_from_pixel = Eigen::Matrix3d::Identity();
  Eigen::Matrix<double, 2, 10> remainder = Eigen::Matrix<double, 2, 10>::Zero();  ///< mm
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();                               ///< px
  double scale_px = 1;
  double rms_mm = 0;  ///< of the corners

  Eigen::Vector2d operator()(const Eigen::Vector2d& pixel) const;
  /// d(board, mm) / d(pixel).
  Eigen::Matrix2d derivative(const Eigen::Vector2d& pixel) const;
};

/// Largest misfit() of a board that was found rightly: a lens leaves far less, corners that were mixed up far
/// more.
inline constexpr double kMaxMisfit = 0.05;

/// rms of the map's corners in squares, or pitches, of the board; of their shorter side.
double misfit(const BoardMap& map, const Target& target);

/// Nothing where the corners lie on a line. `corners` in the order of Target::corner; unseen ones are passed
/// over.
std::optional<BoardMap> fit_board_map(const std::vector<Eigen::Vector2d>& corners, const Target& target);

}  // namespace lightstripe
