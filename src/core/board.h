// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The calibration target: a flat board with a checkerboard, circles or markers.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <string>

#include "core/fields.h"

namespace lightstripe {

enum class TargetType { kCheckerboard, kCharuco, kCircles, kAsymmetricCircles, kAprilgrid };

constexpr std::array<EnumName<TargetType>, 5> enum_names(TargetType) {
  return {{{TargetType::kCheckerboard, "checkerboard"},
           {TargetType::kCharuco, "charuco"},
           {TargetType::kCircles, "circles"},
           {TargetType::kAsymmetricCircles, "asymmetric-circles"},
           {TargetType::kAprilgrid, "aprilgrid"}}};
}

/// Board frame: origin at the first corner, x along a row of corners, y to the next row, z = x cross y (into
/// the board for a viewer in front of it); mm. A "corner" is an inner corner of the squares, the middle of a
/// circle, or a corner of a tag.
struct Target {
  TargetType type = TargetType::kCheckerboard;
  int columns = 0;                         ///< corners along x
  int rows = 0;                            ///< corners along y
  double pitch_x = 0;                      ///< mm; circles: OpenCV's; AprilGrid: half the tags' distance
  double pitch_y = 0;                      ///< mm
  double marker_mm = 0;                    ///< ChArUco, AprilGrid: side of a marker
  std::string dictionary = "DICT_4X4_50";  ///< ChArUco: OpenCV's name of the markers' dictionary
  double tag_gap_mm = 0;                   ///< AprilGrid: between two tags
  double circle_mm = 0;                    ///< diameter of a circle; 0: not known yet, the pictures tell it
  double rim_mm = -1;  ///< plain rim in the board's plane around the pattern; < 0: one pitch

  bool has_circles() const { return type == TargetType::kCircles || type == TargetType::kAsymmetricCircles; }
  int num_corners() const { return columns * rows; }
  /// Asymmetric circles lie as in OpenCV's calibration sample: (2 column + row % 2, row) * pitch.
  Eigen::Vector2d corner(int index) const {
    const int column = index % columns, row = index / columns;
    if (type == TargetType::kAsymmetricCircles) return {(2 * column + row % 2) * pitch_x, row * pitch_y};
    if (type == TargetType::kAprilgrid) return {tag_edge(column), tag_edge(row)};
    return {column * pitch_x, row * pitch_y};
  }
  /// From the first corner to the farthest along x and y.
  Eigen::Vector2d extent() const {
    Eigen::Vector2d last = corner(num_corners() - 1);
    if (type == TargetType::kAsymmetricCircles && rows > 1) return {(2 * columns - 1) * pitch_x, last.y()};
    return last;
  }
  Eigen::Vector2d middle() const { return 0.5 * extent(); }
  /// How far the printed pattern reaches beyond the outer corners.
  Eigen::Vector2d border() const {
    if (has_circles()) return Eigen::Vector2d::Constant(0.5 * circle_mm);
    if (type == TargetType::kAprilgrid) return Eigen::Vector2d::Constant(tag_gap_mm);
    return {pitch_x, pitch_y};
  }
  double rim() const { return rim_mm < 0 ? std::min(pitch_x, pitch_y) : rim_mm; }
  /// Half a turn maps the board onto itself, colours included: its orientation cannot be told from one image.
  bool half_turn_symmetric() const {
    if (type == TargetType::kCircles) return true;
    if (type == TargetType::kAsymmetricCircles) return rows % 2 == 0;
    return type == TargetType::kCheckerboard && (columns + rows) % 2 == 0;
  }

 private:
  double tag_edge(int i) const {
    const int tag = i / 2, edge = i % 2;
    return tag * (marker_mm + tag_gap_mm) + edge * marker_mm;
  }
};

}  // namespace lightstripe
