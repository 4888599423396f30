// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A picture of a cloud: seen obliquely from above, coloured by height, nearer points in front.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "core/profile.h"
#include "core/random.h"

namespace lightstripe {

/// Keeps a bounded, evenly drawn sample of the points (reservoir sampling), whatever the length of the scan.
class CloudPreview {
 public:
  void add(const Profile& profile);
  /// Draws and writes a PNG; azimuth counted about z from x.
  void write(const std::string& path, double azimuth_deg = -60, double elevation_deg = 30) const;

 private:
  static constexpr std::size_t kMaxPoints = 1'000'000;
  std::vector<Eigen::Vector3f> points_;
  std::uint64_t seen_ = 0;
  Random random_{20131};
};

}  // namespace lightstripe
