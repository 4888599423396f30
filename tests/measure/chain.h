// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A stripe whose points lie off a straight reference by known residuals.
#pragma once

#include "measure/closest_points.h"

namespace lightstripe {

struct Chain {
  Section section;
  std::vector<FitPoint> points;

  void add(double place, double residual) {
    FitPoint point;
    point.position = Eigen::Vector2d(place, 0);
    point.normal = Eigen::Vector2d::UnitY();
    point.residual = residual, point.weight = 1, point.index = static_cast<int>(section.size());
    points.push_back(point);
    section.push_back({point.position, 0, 0, 0, 1});
  }
};

}  // namespace lightstripe
