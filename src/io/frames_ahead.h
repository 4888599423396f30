// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// From a slow disk the next pictures come while one is looked at.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>

namespace lightstripe {

/// Which frames of a sequence to ask for. May be used by several threads, which may then ask for one twice.
class FramesAhead {
 public:
  struct Range {
    std::int64_t begin = 0, end = 0;
    bool empty() const { return begin >= end; }
  };

  /// To be asked for now that frame `index` is looked at; `was_cached`: it was in memory already. Where it
  /// was, nothing is asked for, unless a frame not far before it was not: that it was asked for is why.
  Range after(std::int64_t index, bool was_cached) {
    constexpr std::int64_t kAhead = 8, kSlowFor = 64;
    if (!was_cached) slow_until_ = index + kSlowFor;
    if (index >= slow_until_) return {};
    const Range next{std::max(index + 1, asked_.load()), index + 1 + kAhead};
    if (!next.empty()) asked_ = next.end;
    return next;
  }

 private:
  std::atomic<std::int64_t> slow_until_{0}, asked_{0};
};

}  // namespace lightstripe
