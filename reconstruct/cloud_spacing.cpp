// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/cloud_spacing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/robust.h"
#include "reconstruct/cloud.h"

namespace lightstripe {
namespace {

constexpr std::size_t kSamplesAFrame = 16;
constexpr std::size_t kEnough = 200'000;  // distances for a median

float distance(const CloudPoint& a, const CloudPoint& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

double median(std::vector<float>& values) {
  if (values.empty()) return 0;
  return upper_median(values);
}

void add_along(const std::vector<CloudPoint>& frame, std::vector<float>& distances) {
  for (std::size_t i = 1; i < frame.size() && distances.size() < kEnough; ++i)
    if (frame[i].sensor == frame[i - 1].sensor && frame[i].line == frame[i - 1].line)
      distances.push_back(distance(frame[i], frame[i - 1]));
}

void add_between(const std::vector<CloudPoint>& before, const std::vector<CloudPoint>& frame,
                 std::vector<float>& distances) {
  const std::size_t stride = std::max<std::size_t>(1, before.size() / kSamplesAFrame);
  for (std::size_t i = 0; i < before.size() && distances.size() < kEnough; i += stride) {
    float nearest = std::numeric_limits<float>::max();
    for (const CloudPoint& p : frame)
      if (p.sensor == before[i].sensor) nearest = std::min(nearest, distance(p, before[i]));
    if (nearest < std::numeric_limits<float>::max()) distances.push_back(nearest);
  }
}

}  // namespace

CloudSpacing cloud_spacing(const std::filesystem::path& cloud) {
  CloudReader reader(cloud);
  std::vector<CloudPoint> before, frame;
  std::vector<float> along, between;
  while (reader.next_frame(frame)) {
    add_along(frame, along);
    add_between(before, frame, between);
    before.swap(frame);
  }
  return {median(along), median(between)};
}

}  // namespace lightstripe
