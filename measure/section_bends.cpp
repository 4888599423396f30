// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/section_bends.h"

#include <cmath>

namespace lightstripe {
namespace {

/// `of` names the list of a row in which the estimate stands at `index`.
void add_bends(const std::vector<MeasuredFrame>& bent_rows, std::vector<NamedEstimate> MeasuredFrame::*of,
               std::size_t index, Estimate& estimate) {
  if (!estimate.value || !estimate.sigma) return;
  double squares = *estimate.sigma * *estimate.sigma;
  for (const MeasuredFrame& bent : bent_rows)
    if (index < (bent.*of).size())
      if (const auto& value = (bent.*of)[index].estimate.value)
        squares += (*value - *estimate.value) * (*value - *estimate.value);
  estimate.sigma = std::sqrt(squares);
}

}  // namespace

Profile bent(const Profile& profile, const SectionBends& bends, std::size_t bend) {
  Profile out = profile;
  for (ProfilePoint& p : out.points) {
    const Eigen::Vector2d by = displacement(bends, bend, p.sensor, p.u, p.v);
    p.u += by.x(), p.v += by.y();
  }
  return out;
}

void add_bends(const std::vector<MeasuredFrame>& bent_rows, MeasuredFrame& row) {
  for (auto of : {&MeasuredFrame::estimates, &MeasuredFrame::extras})
    for (std::size_t i = 0; i < (row.*of).size(); ++i) add_bends(bent_rows, of, i, (row.*of)[i].estimate);
}

}  // namespace lightstripe
