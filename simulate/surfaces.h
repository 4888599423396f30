// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What rays can meet: boards, extruded outlines, balls, the ground. World frame, mm.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/board.h"
#include "core/outline.h"
#include "core/transform.h"
#include "simulate/revolution.h"
#include "simulate/scene_objects.h"

namespace lightstripe {

struct Ray {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;  ///< any length

  Eigen::Vector3d at(double s) const { return origin + s * direction; }
};

struct SurfaceHit {
  double s = 0;            ///< at ray.at(s)
  Eigen::Vector3d normal;  ///< unit, towards the side that the ray comes from
  Material material;
};

/// A flat checkerboard in the frame of core/board.h. The square beyond the first inner corner is white, as
/// where cv::findChessboardCornersSB begins.
struct BoardSurface {
  Rigid3 world_from_board;
  Target target;
  double quiet_border_mm = 0;
  double white_albedo = 1, black_albedo = 0;
};

/// A run of an outline's segments with a circle around it, so that rays can skip it.
struct BoundedRun {
  Outline segments;
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  double radius = 0;
};

/// An outline drawn out along its own x: section coordinates (u, v) are the solid's (y, z).
struct Extrusion {
  Rigid3 world_from_solid;
  BoundedRun outline;
  double length_mm = 0;  ///< centred on the solid's origin; 0 = endless
  Material material;
  std::vector<BoundedRun> runs;  ///< the outline in parts
};

/// Splits the outline into bounded runs.
Extrusion make_extrusion(const Rigid3& world_from_solid, const Outline& outline, double length_mm,
                         const Material& material);

/// Everything that the sensors see at one moment.
struct World {
  std::vector<BoardSurface> boards;
  std::vector<Extrusion> extrusions;
  std::vector<Revolution> revolutions;
  std::vector<SphereObject> spheres;
  std::optional<GroundObject> ground;
};

/// The nearest surface with s > 0.
std::optional<SurfaceHit> first_hit(const World& world, const Ray& ray);

/// Whether anything stands between two points; the surface that `to` lies on does not count.
bool blocked(const World& world, const Eigen::Vector3d& from, const Eigen::Vector3d& to);

}  // namespace lightstripe
