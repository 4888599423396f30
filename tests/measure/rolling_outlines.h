// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Built-in outlines of wheels and rails for tests of conicity.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "io/nominal_outlines.h"
#include "measure/conicity.h"

namespace lightstripe {

/// Points of an outline that look up, turned, from left to right.
inline std::vector<Eigen::Vector2d> upper(const char* name, double turn_rad, double from, double to,
                                          double sign) {
  using Eigen::Vector2d;
  std::vector<Vector2d> out;
  for (const OutlineSample& p : sample(read_nominal(name), 0.1)) {
    const Vector2d turned = Eigen::Rotation2Dd(turn_rad) * p.position;
    if (p.normal.y() > 0.05 && turned.y() > -16 && turned.x() > from && turned.x() < to)
      out.emplace_back(turned.x(), sign * turned.y());
  }
  std::sort(out.begin(), out.end(), [](const Vector2d& a, const Vector2d& b) { return a.x() < b.x(); });
  return out;
}

/// The part of an S1002 that rolls.
inline RollingProfile s1002_wheel() {
  return {"S1002", RunningSurface::exact(upper("S1002", 0, -50, 55, -1)), 0, 0};
}

}  // namespace lightstripe
