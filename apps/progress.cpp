// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace lightstripe {

using std::chrono::steady_clock;

std::string progress_line(const std::string& verb, const std::string& unit, std::int64_t done,
                          std::int64_t total, double seconds) {
  constexpr int kBarWidth = 24;
  const double part = total > 0 ? static_cast<double>(done) / static_cast<double>(total) : 1.0;
  const int filled = static_cast<int>(part * kBarWidth);
  const double rate = seconds > 0 ? static_cast<double>(done) / seconds : 0.0;
  const std::string left =
      rate > 0 ? fmt::format("{:.0f} s left", static_cast<double>(total - done) / rate) : "";
  return fmt::format("{} [{:#<{}}{:.<{}}] {}/{} {}, {:.1f}/s, {}", verb, "", filled, "", kBarWidth - filled,
                     done, total, unit, rate, left);
}

Progress::Progress(std::string verb, std::string unit, std::int64_t total, bool quiet)
    : verb_(std::move(verb)),
      unit_(std::move(unit)),
      total_(total),
      shown_(!quiet && isatty(STDERR_FILENO) == 1),
      start_(steady_clock::now()),
      last_drawn_(start_) {}

Progress::~Progress() {
  if (shown_) fmt::print(stderr, "\r\033[K");
}

void Progress::step() {
  const std::scoped_lock lock(mutex_);
  ++done_;
  if (shown_) draw();
}

void Progress::draw() {
  constexpr std::chrono::milliseconds kRedraw{100};
  const auto now = steady_clock::now();
  if (now - last_drawn_ < kRedraw && done_ < total_) return;
  last_drawn_ = now;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  fmt::print(stderr, "\r\033[K{}", progress_line(verb_, unit_, done_, total_, seconds));
  std::fflush(stderr);
}

}  // namespace lightstripe
