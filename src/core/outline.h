// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A planar outline of straight lines and circular arcs, mm: the section of a rail, a staircase, a circle.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace lightstripe {

/// A straight line or a circular arc with its direction of passage.
struct OutlineSegment {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
  double radius = 0;  ///< 0 = straight
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  bool counterclockwise = true;  ///< sense of an arc on the way `from` -> `to`

  bool straight() const { return radius == 0; }
};

OutlineSegment line_segment(const Eigen::Vector2d& from, const Eigen::Vector2d& to);
/// The shorter of the two arcs about `center`; its radius is the mean of the two ends' distances.
OutlineSegment arc_segment(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                           const Eigen::Vector2d& center);

/// A chain of segments, each beginning where the one before ends. A closed one bounds material on its left,
/// i.e. it is passed counterclockwise.
struct Outline {
  std::vector<OutlineSegment> segments;

  bool closed() const;
};

/// Largest gap between two segments that still counts as joined, mm (tabulated outlines are rounded to 1e-5).
inline constexpr double kOutlineJointMm = 1e-4;

/// The chain backwards.
Outline reversed(const Outline& outline);
/// A half (u >= 0, from the axis u = 0 back to it) and its mirror image, as one closed counterclockwise
/// outline.
Outline mirrored(const Outline& half);
Outline circle_outline(double radius);
/// The polygon through these corners, closed, made counterclockwise.
Outline polygon_outline(const std::vector<Eigen::Vector2d>& corners);

double length(const OutlineSegment& segment);
/// The point at share t in [0, 1] of the segment's length.
Eigen::Vector2d point_at(const OutlineSegment& segment, double t);
/// Unit normal there, on the right of the passage: outwards for a closed outline.
Eigen::Vector2d normal_at(const OutlineSegment& segment, double t);

struct OutlineSample {
  Eigen::Vector2d position;
  Eigen::Vector2d normal;  ///< as normal_at
  double arc_length = 0;   ///< mm from the outline's beginning
  int segment = 0;
};

/// Points on the outline not farther apart than `spacing_mm` along it; each segment's ends are among them.
/// A closed outline's first point is not repeated at the end.
std::vector<OutlineSample> sample(const Outline& outline, double spacing_mm);

struct OutlineHit {
  double s = 0;            ///< the crossing is origin + s * direction
  Eigen::Vector2d normal;  ///< unit, on the right of the passage
  int segment = 0;
};

/// The nearest crossing with s > `min_s`; nothing if the ray misses. A crossing within 2e-5 mm of a joint
/// counts.
std::optional<OutlineHit> first_hit(const Outline& outline, const Eigen::Vector2d& origin,
                                    const Eigen::Vector2d& direction, double min_s);

/// Whether a point lies inside a closed outline (winding number, exact for arcs).
bool contains(const Outline& outline, const Eigen::Vector2d& point);

struct OutlineFoot {
  Eigen::Vector2d position;  ///< the nearest point of the outline
  Eigen::Vector2d normal;    ///< unit, on the right of the passage there
  double distance = 0;       ///< mm, >= 0
  int segment = 0;
};

/// The foot of the perpendicular (or the nearest end) from a point to the outline, which must not be empty.
OutlineFoot closest_point(const Outline& outline, const Eigen::Vector2d& point);

struct SectionProperties {
  double area = 0;  ///< mm^2
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();
  double inertia_u =
      0;  ///< mm^4, second moment about the centroid's axis parallel to u (bending up and down)
  double inertia_v = 0;  ///< mm^4, about the centroid's axis parallel to v (bending sideways)
};

/// Of a closed counterclockwise outline, by Green's theorem; arcs by Gauss quadrature to rounding error.
SectionProperties section_properties(const Outline& outline);

}  // namespace lightstripe
