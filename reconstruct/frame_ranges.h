// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Frames that have something in common, as runs: short however long the recording is.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace lightstripe {

struct FrameRanges {
  std::vector<std::pair<std::int64_t, std::int64_t>> runs;  ///< first and last frame, ascending
  std::int64_t count = 0;

  /// Frames have to come in ascending order.
  void add(std::int64_t frame);
  bool empty() const { return count == 0; }
  /// "3 to 7, 12, 20 to 21"; behind `max_runs` of them "...".
  std::string text(std::size_t max_runs = 8) const;
};

}  // namespace lightstripe
