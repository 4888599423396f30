// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/frame_ranges.h"

#include <fmt/format.h>

#include "core/error.h"

namespace lightstripe {

void FrameRanges::add(std::int64_t frame) {
  LIGHTSTRIPE_CHECK(runs.empty() || frame > runs.back().second, "frames come in ascending order");
  ++count;
  if (!runs.empty() && runs.back().second + 1 == frame)
    runs.back().second = frame;
  else
    runs.emplace_back(frame, frame);
}

std::string FrameRanges::text(std::size_t max_runs) const {
  std::string out;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (i > 0) out += ", ";
    if (i == max_runs) return out + "...";
    out += fmt::format("{}", runs[i].first);
    if (runs[i].second > runs[i].first) out += fmt::format(" to {}", runs[i].second);
  }
  return out;
}

}  // namespace lightstripe
