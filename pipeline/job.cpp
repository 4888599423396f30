// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/job.h"

#include <opencv2/core/utility.hpp>
#include <utility>

namespace lightstripe {

StepCounter::StepCounter(std::string_view verb, std::string_view unit, std::int64_t total,
                         ProgressCallback tell)
    : progress_{verb, unit, 0, total}, tell_(std::move(tell)) {}

void StepCounter::step() {
  const std::scoped_lock lock(mutex_);
  ++progress_.done;
  if (tell_) tell_(progress_);
}

JobThreads::JobThreads(int threads) : limit_(threads), opencv_before_(cv::getNumThreads()) {
  cv::setNumThreads(1);
}
JobThreads::~JobThreads() { cv::setNumThreads(opencv_before_); }

}  // namespace lightstripe
