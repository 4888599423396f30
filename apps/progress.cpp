// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>

namespace lightstripe {
namespace {

using std::chrono::steady_clock;

class Line {
 public:
  ~Line() {
    if (drawn_) std::fputs("\r\033[K", stderr);
  }

  void draw(const JobProgress& progress) {
    constexpr std::chrono::milliseconds kRedraw{100};
    const auto now = steady_clock::now();
    if (now - last_drawn_ < kRedraw && progress.done < progress.total) return;
    drawn_ = true;
    last_drawn_ = now;
    const double seconds = std::chrono::duration<double>(now - start_).count();
    std::string text = progress_text(progress, seconds);
    text.resize(std::min(text.size(), terminal_width() - 1));  // a line that wraps is not drawn over
    text = "\r\033[K" + text;
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
  }

 private:
  bool drawn_ = false;
  steady_clock::time_point start_ = steady_clock::now(), last_drawn_ = start_;
};

}  // namespace

std::size_t terminal_width() {
  constexpr std::size_t kUsual = 80;
  winsize size{};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1 ? size.ws_col : kUsual;
}

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
