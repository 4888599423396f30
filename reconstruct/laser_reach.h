// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Where in the image each laser plane's light may lie, and in which order the planes' lines follow each
// other.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/rig.h"
#include "core/stripe.h"

namespace lightstripe {

/// How well a plane explains a line: by depths within the rig's range, near it, or far from it.
enum class Reach { kInside, kNear, kFar };

/// A plane that may have lit a line, and the depths at which the line then lies.
struct PlaneCandidate {
  int plane = 0;
  Reach reach = Reach::kInside;
  std::array<double, 2> depth_mm{0, 0};  ///< nearest, farthest of nine tenths of the line
};

/// A stripe as the assignment of planes sees it.
struct LineInImage {
  std::vector<PlaneCandidate> candidates;  ///< by plane; empty: no plane's light
  std::vector<Eigen::Vector2d> pixels;     ///< samples along it
  double first = 0, last = 0, place = 0;   ///< extent along the stripes' common direction, mean across; px
};

/// Unit normal of the stripes in the image: the mean direction across them, signs made equal.
Eigen::Vector2d common_normal(const std::vector<Stripe>& stripes);

/// Needs Sensor::depth_range_mm. The range is what the boards covered (or a guess typed in), so that an
/// object may stick out of it: planes that explain a line from half the nearest depth to twice the farthest
/// are candidates too.
LineInImage line_in_image(const Stripe& stripe, const Sensor& sensor, const Eigen::Vector2d& normal);

/// Whether both are seen at the same place along the stripes, by more than the ends of one line's pieces
/// overlap at a step of the surface.
bool are_beside(const LineInImage& a, const LineInImage& b);

/// Whether two lines may be of these planes: lines beside each other lie in the order of their planes (of
/// lines that cross: at both ends) and share none.
bool are_compatible(const Sensor& sensor, const LineInImage& a, const PlaneCandidate& plane_a,
                    const LineInImage& b, const PlaneCandidate& plane_b, const Eigen::Vector2d& normal);

}  // namespace lightstripe
