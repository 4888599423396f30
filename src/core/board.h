// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The calibration target: a flat board with a checkerboard.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>

#include "core/fields.h"

namespace lightstripe {

enum class TargetType { kCheckerboard, kCharuco };

constexpr std::array<EnumName<TargetType>, 2> enum_names(TargetType) {
  return {{{TargetType::kCheckerboard, "checkerboard"}, {TargetType::kCharuco, "charuco"}}};
}

/// Board frame: origin at the first inner corner, x along a row of corners, y to the next row, z = x cross y
/// (into the board for a viewer in front of it); mm.
struct Target {
  TargetType type = TargetType::kCheckerboard;
  int columns = 0;                         ///< inner corners along x
  int rows = 0;                            ///< inner corners along y
  double pitch_x = 0;                      ///< mm
  double pitch_y = 0;                      ///< mm
  double marker_mm = 0;                    ///< ChArUco: side of a marker
  std::string dictionary = "DICT_4X4_50";  ///< ChArUco: OpenCV's name of the markers' dictionary

  int num_corners() const { return columns * rows; }
  Eigen::Vector2d corner(int index) const {
    return {(index % columns) * pitch_x, (index / columns) * pitch_y};
  }
  /// Half a turn maps the board onto itself, colours included: its orientation cannot be told from one image.
  bool half_turn_symmetric() const { return type == TargetType::kCheckerboard && (columns + rows) % 2 == 0; }
};

}  // namespace lightstripe
