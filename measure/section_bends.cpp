// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/section_bends.h"

#include <algorithm>
#include <cmath>

namespace lightstripe {
Profile bent(const Profile& profile, const SectionBends& bends, std::size_t bend) {
  Profile out = profile;
  for (ProfilePoint& p : out.points) {
    const Eigen::Vector2d by = displacement(bends, bend, p.sensor, p.u, p.v);
    p.u += by.x(), p.v += by.y();
  }
  return out;
}

void add_bend(const Estimate& bent, Estimate& estimate) {
  if (!estimate.value || !estimate.sigma || !bent.value) return;
  estimate.sigma = std::hypot(*estimate.sigma, *bent.value - *estimate.value);
}

void add_bends(const std::vector<MeasuredFrame>& bent_rows, MeasuredFrame& row) {
  for (const MeasuredFrame& bent : bent_rows)
    for (auto of : {&MeasuredFrame::estimates, &MeasuredFrame::extras})
      for (std::size_t i = 0; i < std::min((row.*of).size(), (bent.*of).size()); ++i)
        add_bend((bent.*of)[i].estimate, (row.*of)[i].estimate);
}

}  // namespace lightstripe
