// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/travel.h"

#include <algorithm>
#include <cmath>

namespace lightstripe {

std::optional<FramePosition> position_at(const TravelReadings& readings, MotionType motion,
                                         std::int64_t frame) {
  constexpr double kHalfTurn = 180;
  const auto next = std::lower_bound(readings.begin(), readings.end(), frame,
                                     [](const auto& reading, std::int64_t f) { return reading.first < f; });
  if (next == readings.end()) return std::nullopt;
  if (next->first == frame) return FramePosition{next->second, std::nullopt, false};
  if (next == readings.begin()) return std::nullopt;
  const auto before = std::prev(next);
  const double difference = next->second - before->second;
  if (motion == MotionType::kRotary && std::abs(difference) > kHalfTurn) return std::nullopt;
  const double share =
      static_cast<double>(frame - before->first) / static_cast<double>(next->first - before->first);
  return FramePosition{before->second + share * difference, std::nullopt, true};
}

}  // namespace lightstripe
