// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What a section is compared with: a nominal outline, or an earlier scan of the same place (baseline).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/outline.h"
#include "core/polyline_search.h"
#include "measure/section.h"

namespace lightstripe {

enum class ObjectKind { kRail, kWheel };

/// Which part of the object a point of the reference belongs to. Rail: the running surface (crown, shoulders,
/// corners), the two head faces, and what lies below on either side (+u, -u). Wheel: what runs on the rail
/// (tread, flange face), the flange's top and its rounding to the back, the back, and the field side (outer
/// tread, chamfer, outer face).
enum class Zone : std::uint8_t {
  kRunning,
  kFaceRight,
  kFaceLeft,
  kBelowRight,
  kBelowLeft,
  kFlangeTop,
  kBack,
  kField
};
inline constexpr int kZones = 8;

class ReferenceShape {
 public:
  /// `outline`: u lateral, v up; rail: origin at the top on the centreline; wheel: flange to the left, origin
  /// at the tread datum. Closed, or the open chain of a baseline.
  ReferenceShape(std::string name, ObjectKind kind, Outline outline);

  const std::string& name() const { return name_; }
  ObjectKind kind() const { return kind_; }
  const Outline& outline() const { return outline_; }
  double top_v() const { return top_v_; }  ///< rail: highest point of the head; wheel: flange tip
  double top_u() const { return top_u_; }  ///< rail: centreline; wheel: flange tip
  double head_bottom_v() const {
    return bottom_v_;
  }  ///< rail: where the head is widest, lower end of its faces

  /// Within kReachMm of the outline.
  static constexpr double kReachMm = 6.0;
  /// The foot on the outline's polyline, by a map of nearest vertices and a walk from there: where two parts
  /// of the outline are equally near (within a millimetre) it may be either's.
  std::optional<PolylineFoot> nearest(const Eigen::Vector2d& p) const;
  /// Of a foot, from the outline's beginning, mm.
  double arc_length(const PolylineFoot& foot) const;
  Zone zone(const PolylineFoot& foot) const { return zones_[static_cast<std::size_t>(foot.segment)]; }
  /// Distance to the outline within about a millimetre, cut off at 20.
  double coarse_distance(const Eigen::Vector2d& p) const {
    const std::ptrdiff_t cell = cell_of(p);
    return cell < 0 ? kFarthestMm : static_cast<double>(distances_[static_cast<std::size_t>(cell)]);
  }

  /// Where a ray from outside first meets the outline: the coordinate along `outwards` (unit) from `origin`,
  /// on the line that runs `across_mm` to the left of it. Nothing where the ray misses.
  std::optional<double> surface_along(const Eigen::Vector2d& origin, const Eigen::Vector2d& outwards,
                                      double across_mm) const;

 private:
  static constexpr double kCellMm = 1.0;       // of the map
  static constexpr double kFarthestMm = 20.0;  // distances are cut off here

  void find_landmarks();
  Zone zone_at(const Eigen::Vector2d& p) const;
  void fill_map();
  void propagate(int column, int row, int from_column, int from_row);
  std::size_t cell_index(int column, int row) const;
  /// The cell that a point lies in; -1 outside the map.
  std::ptrdiff_t cell_of(const Eigen::Vector2d& p) const {
    const double column = (p.x() - corner_.x()) / kCellMm, row = (p.y() - corner_.y()) / kCellMm;
    if (!(column >= 0 && row >= 0 && column < columns_ && row < rows_)) return -1;
    return static_cast<std::ptrdiff_t>(row) * columns_ + static_cast<std::ptrdiff_t>(column);
  }
  PolylineFoot foot_on(std::size_t segment, const Eigen::Vector2d& p) const;

  std::string name_;
  ObjectKind kind_;
  Outline outline_;
  std::vector<Eigen::Vector2d> vertices_;
  std::vector<double> lengths_;  // along the outline, of each vertex
  std::vector<Zone> zones_;      // of each segment of the polyline
  double top_u_ = 0, top_v_ = 0, bottom_v_ = 0;
  Eigen::Vector2d corner_ = Eigen::Vector2d::Zero();  // of the map
  int columns_ = 0, rows_ = 0;
  std::vector<float> distances_;  // from each cell's middle, cut off
  std::vector<int> nearest_;      // vertex, -1: too far
};

/// The chain through a section's points in their order (a MiniProf recording); points closer together than
/// 1e-3 mm are one. Needs ten.
Outline outline_of_section(const Section& section);

}  // namespace lightstripe
