// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A picture of a cloud: seen obliquely from above, coloured by height, nearer points in front.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/profile.h"
#include "core/random.h"
#include "pipeline/reconstruct_job.h"

namespace lightstripe {

struct RgbPicture {
  std::vector<std::uint8_t> pixels;  ///< interleaved, width * height * 3
  int width = 0, height = 0;
};

/// Keeps a bounded, evenly drawn sample of the points (reservoir sampling), whatever the length of the scan.
class CloudPreview {
 public:
  void add(const Profile& profile);
  /// The cloud from `azimuth_deg` (about z, from x) and `elevation_deg` (above the x-y plane).
  RgbPicture draw(int width = 1200, int height = 800, double azimuth_deg = -60,
                  double elevation_deg = 30) const;

 private:
  static constexpr std::size_t kMaxPoints = 1'000'000;
  std::vector<Eigen::Vector3f> points_;
  std::uint64_t seen_ = 0;
  Random random_{20131};
};

/// Makes the job collect its points in `preview`, which has to live as long as the job, and draw them into
/// `file` at its end.
void draw_preview_of(ReconstructJob& job, CloudPreview& preview, const std::filesystem::path& file);

/// Pictures side by side above one more, each scaled to its place: the demo's overview.
RgbPicture compose_overview(const std::vector<RgbPicture>& top, const RgbPicture& bottom);

}  // namespace lightstripe
