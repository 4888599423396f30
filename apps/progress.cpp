// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <memory>

namespace lightstripe {
namespace {

using std::chrono::steady_clock;

class Line {
 public:
  ~Line() {
    if (drawn_) fmt::print(stderr, "\r\033[K");
  }

  void draw(const JobProgress& progress) {
    constexpr std::chrono::milliseconds kRedraw{100};
    const auto now = steady_clock::now();
    if (now - last_drawn_ < kRedraw && progress.done < progress.total) return;
    drawn_ = true;
    last_drawn_ = now;
    const double seconds = std::chrono::duration<double>(now - start_).count();
    fmt::print(stderr, "\r\033[K{}", progress_text(progress, seconds));
    std::fflush(stderr);
  }

 private:
  bool drawn_ = false;
  steady_clock::time_point start_ = steady_clock::now(), last_drawn_ = start_;
};

}  // namespace

std::string progress_text(const JobProgress& progress, double seconds) {
  constexpr int kBarWidth = 24;
  const auto done = static_cast<double>(progress.done), total = static_cast<double>(progress.total);
  const int filled = static_cast<int>((total > 0 ? done / total : 1.0) * kBarWidth);
  const double rate = seconds > 0 ? done / seconds : 0.0;
  const std::string left = rate > 0 ? fmt::format("{:.0f} s left", (total - done) / rate) : "";
  return fmt::format("{} [{:#<{}}{:.<{}}] {}/{} {}, {:.1f}/s, {}", progress.verb, "", filled, "",
                     kBarWidth - filled, progress.done, progress.total, progress.unit, rate, left);
}

ProgressCallback progress_line(bool quiet) {
  if (quiet || isatty(STDERR_FILENO) != 1) return {};
  return [line = std::make_shared<Line>()](const JobProgress& progress) { line->draw(progress); };
}

}  // namespace lightstripe
