// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A body of revolution (a wheel) and where a ray meets it. World frame, mm.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/outline.h"
#include "core/transform.h"
#include "simulate/scene_objects.h"

namespace lightstripe {

/// A corner of the section, (position along the axis, radius), with the section's unit normal there.
struct SectionNode {
  Eigen::Vector2d position;
  Eigen::Vector2d normal;  ///< outwards
};

/// The x axis of the solid's frame is the axis. Between two nodes the surface is a cone, its normal runs
/// evenly from one to the other.
struct Revolution {
  Rigid3 world_from_solid;
  Material material;

  struct Piece {
    SectionNode from, to;
    Eigen::Vector2d along, across;  ///< unit: from one to the other, and outwards
    double length_mm;
  };
  std::vector<Piece> pieces;
  /// Bounds of the pieces in a binary tree: the children of i are 2 i + 1 and 2 i + 2, its leaves hold
  /// kLeafPieces pieces each.
  struct Bounds {
    double u0 = 0, u1 = 0, r0 = 0, r1 = 0;
  };
  std::vector<Bounds> tree;
  std::size_t num_leaves = 0;
  static constexpr std::size_t kLeafPieces = 4;
};

/// `section`: closed, counterclockwise, (u, v) with the radius v + datum_radius_mm > 0. Curves are followed
/// by cones `spacing_mm` long.
Revolution make_revolution(const Rigid3& world_from_solid, const Outline& section, double datum_radius_mm,
                           const Material& material, double spacing_mm = 0.1);

struct RevolutionHit {
  double s = 0;            ///< at origin + s * direction, s > 0
  Eigen::Vector3d normal;  ///< unit, towards where the ray comes from
};

std::optional<RevolutionHit> first_hit(const Revolution& solid, const Eigen::Vector3d& origin,
                                       const Eigen::Vector3d& direction);

}  // namespace lightstripe
