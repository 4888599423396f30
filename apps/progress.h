// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A progress line on stderr: done, rate, time left. Only on a terminal, and never when quiet.
#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

namespace lightstripe {

class Progress {
 public:
  /// `what`: the verb and the unit, "reconstructing", "frames".
  Progress(std::string verb, std::string unit, std::int64_t total, bool quiet);
  ~Progress();  ///< clears the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// One more is done; may be called from several threads.
  void step();

 private:
  void draw();

  std::string verb_, unit_;
  std::int64_t total_, done_ = 0;
  bool shown_;
  std::mutex mutex_;
  std::chrono::steady_clock::time_point start_, last_drawn_;
};

/// The line that is drawn; a function of its own so that it can be tested.
std::string progress_line(const std::string& verb, const std::string& unit, std::int64_t done,
                          std::int64_t total, double seconds);

}  // namespace lightstripe
