// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Clouds of known surfaces as files, for what is made of clouds.
#pragma once

#include <cmath>
#include <filesystem>
#include <functional>
#include <vector>

#include "core/profile.h"
#include "reconstruct/cloud.h"

namespace lightstripe {

/// One frame: a stripe at x over y from -20 to 20 every 0.13 mm; z from the surface, NaN: not seen, the
/// stripe goes on as another line.
inline Profile stripe_over(std::int64_t frame, double x, const std::function<double(double, double)>& surface,
                           int sensor = 0, double spacing_mm = 0.13) {
  Profile profile;
  profile.frame = frame;
  int line = 0;
  for (double y = -20; y <= 20; y += spacing_mm) {
    const double z = surface(x, y);
    if (std::isnan(z)) {
      if (!profile.points.empty() && profile.points.back().line == line) ++line;
      continue;
    }
    ProfilePoint p;
    p.position = {x, y, z};
    p.u = y, p.v = z;
    p.sigma_mm = 0.01;
    p.intensity = static_cast<float>(100 + y);
    p.sensor = sensor;
    p.line = line;
    profile.points.push_back(p);
  }
  return profile;
}

inline void write_cloud(const std::filesystem::path& path, const std::vector<Profile>& profiles) {
  CloudWriter writer(path);
  for (const Profile& profile : profiles) writer.append(profile);
  writer.finish();
}

}  // namespace lightstripe
