// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Stripes of the views as points in space, and the planes through them, for start values.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "calib/start/initial_values.h"

namespace lightstripe {

inline constexpr std::size_t kMinStripePoints = 3;  // of a stripe on one board

/// The stripe of one view, in space: rays cut with the board's plane.
struct StripeInSpace {
  std::size_t view = 0;
  std::size_t plane = 0;                ///< place in the view's list of stripes
  std::vector<Eigen::Vector3d> points;  ///< camera frame, mm
};

/// The stripe points of view `of` cut with the board of view `board`, which is its own unless pairs were
/// mixed up.
StripeInSpace stripe_in_space(const InitialValues& values, std::size_t of, std::size_t board,
                              std::size_t plane);

/// Of the stripe on that place in the views' lists.
std::vector<StripeInSpace> stripes_in_space(const InitialValues& values, int sensor, std::size_t plane);

/// Median distance of the points, mm.
double distance_to(const Plane& plane, const StripeInSpace& stripe);

PlaneFit plane_through(const std::vector<const StripeInSpace*>& stripes);

/// Least median over the views of the plane through two of them: up to half of the views may show something
/// else.
std::optional<Plane> least_median_plane(const std::vector<StripeInSpace>& stripes);

/// The stripes that lie in one plane, judged roughly first and then by the spread of those that do; all of
/// them where no two stripes span a plane.
std::vector<const StripeInSpace*> stripes_in_one_plane(const std::vector<StripeInSpace>& stripes);

/// A sensor with several laser planes: sorts every view's stripes so that place k is the same plane in all
/// views. The views list them by their place across the image, which crossing lines and missed ones upset;
/// planes through the majority and the nearest plane for each stripe, in turns, put them right.
void label_stripes(InitialValues& values, int sensor, std::size_t planes);

}  // namespace lightstripe
