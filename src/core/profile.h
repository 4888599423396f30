// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What reconstruction makes of the stripes: one section of the object a frame.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

namespace lightstripe {

struct ProfilePoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< mm, rig frame at travel 0 (or the poses' world)
  double u = 0, v = 0;  ///< section coordinates, mm: y, z of the rig frame; rotary: along the axis, radius
  double sigma_mm = 0;  ///< predicted 1-sigma error in the section
  float intensity = 0;  ///< peak grey level above the background
  int sensor = 0;       ///< index into Rig::sensors
  int line = 0;         ///< stripe, counted from 0 in each frame and sensor
};

/// Stripe points that were dropped because their line may lie outside the sensor's depth range.
struct OutsideRange {
  int sensor = 0;  ///< index into Rig::sensors
  std::int64_t points = 0;
  double nearest_mm = 0, farthest_mm = 0;  ///< depths of those that lie there for certain; 0, 0: none does
};

/// All points of one frame, sensors in the rig's order, lines in the order of extraction, points along the
/// line.
struct Profile {
  std::int64_t frame = 0;
  double travel = 0;  ///< mm or degrees; missing with poses (0)
  std::vector<ProfilePoint> points;
  /// Stripe points whose ray could not be undistorted or does not meet the plane, or whose plane is not
  /// certain.
  int num_missed = 0;
  std::vector<OutsideRange> outside;  ///< of these: by sensor, where there are any
};

}  // namespace lightstripe
