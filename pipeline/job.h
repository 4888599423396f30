// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What every job is given besides its data: where to tell how far it is, and how many threads it may use.
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <string_view>

#include "parallel/parallel.h"

namespace lightstripe {

/// How far a job is: "reconstructing", "frames", 7 of 240.
struct JobProgress {
  std::string_view verb, unit;
  std::int64_t done = 0, total = 0;
};

/// Called after each step, from any thread but never from two at once.
using ProgressCallback = std::function<void(const JobProgress&)>;

/// Counts the steps of a job that runs on several threads, and tells each.
class StepCounter {
 public:
  StepCounter(std::string_view verb, std::string_view unit, std::int64_t total, ProgressCallback tell);
  /// One more is done.
  void step();

 private:
  JobProgress progress_;
  ProgressCallback tell_;
  std::mutex mutex_;
};

/// Limits a job to its threads (0 = all cores) for as long as it lives. OpenCV is kept to one thread: what
/// runs in parallel in a job runs image by image.
class JobThreads {
 public:
  explicit JobThreads(int threads);
  ~JobThreads();
  JobThreads(const JobThreads&) = delete;
  JobThreads& operator=(const JobThreads&) = delete;

 private:
  ThreadLimit limit_;
  int opencv_before_;
};

}  // namespace lightstripe
