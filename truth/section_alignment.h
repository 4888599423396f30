// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A measured section laid onto a known shape by one rigid move: what remains is the error of the section's
// shape.
#pragma once

#include <Eigen/Core>
#include <span>

#include "core/section_move.h"

namespace lightstripe {

struct SectionAlignmentOptions {
  double search_mm = 5.0;  ///< points farther from the shape have no counterpart; > the offset to be found
  double far_mm = 1.0;     ///< points farther off after the move count as wrong, and not into the rms
  double min_scale_mm =
      0.02;  ///< robust scale below which Tukey's weights do not narrow further: the expected noise
  int max_iterations = 60;
};

struct SectionAlignment {
  SectionMove shape_from_measured;
  double rms_mm = 0;     ///< distances to the shape, of the points that are not far
  double median_mm = 0;  ///< of the absolute distances, all points (search_mm where there is no counterpart)
  double far_fraction = 0;  ///< of all points
  int num_points = 0;       ///< that are not far
  bool converged = false;   ///< the last step was below 1e-7 mm at every point
  bool determined = false;  ///< the shape holds the move in all three directions (a straight line does not)
};

/// The best rigid move of `measured` (u, v; mm) onto the polyline `shape` (its vertices in order, dense where
/// it curves; closed if the last equals the first): iterative closest point, point to line (Chen and Medioni
/// 1992), with Tukey's biweight at a scale of 1.4826 times the median distance. Directions that the shape
/// does not hold are left alone. Needs 3 points and 2 vertices.
SectionAlignment align_section(std::span<const Eigen::Vector2d> measured,
                               std::span<const Eigen::Vector2d> shape,
                               const SectionAlignmentOptions& options = {});

}  // namespace lightstripe
