// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A line on stderr about something that has no known end. Only on a terminal, and never when quiet.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <string>

#include "apps/progress.h"

namespace lightstripe {

class StatusLine {
 public:
  explicit StatusLine(bool quiet) : shown_(!quiet && isatty(STDERR_FILENO) == 1) {}

  /// Four times a second the line is made and drawn.
  void show(const std::function<std::string()>& text) {
    const auto now = std::chrono::steady_clock::now();
    if (!shown_ || now - last_ < std::chrono::milliseconds(250)) return;
    last_ = now;
    std::string line = text();
    line.resize(std::min(line.size(), terminal_width() - 1));  // a line that wraps is not drawn over
    std::fputs(("\r" + line + "\x1b[K").c_str(), stderr);
  }
  void clear() const {
    if (shown_) std::fputs("\r\x1b[K", stderr);
  }

 private:
  bool shown_;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace lightstripe
