// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/camera_recorders.h"

#include <fmt/format.h>

#include "core/error.h"
#include "pipeline/record_frames.h"

namespace lightstripe {

CameraRecorders::CameraRecorders(ReconstructJob& job) {
  for (auto& [sensor, pattern] : job.scan.frames) {
    if (!is_camera(pattern)) continue;
    RecordJob record;
    record.source = pattern;
    record.folder = job.cloud.parent_path() / (job.cloud.stem().string() + ".frames") / sensor;
    record.channel = job.scan.channel;
    pattern = (std::filesystem::absolute(record.folder) / "*.pgm").string();
    threads_.emplace_back([this, record](const std::stop_token& stop) {
      try {
        record_frames(record, stop, [](const RecordSummary&) {});
      } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (!error_) error_ = std::current_exception();
        failed_.request_stop();
      }
    });
  }
}

void CameraRecorders::end() {
  threads_.clear();
  if (error_) std::rethrow_exception(error_);
}

void refuse_camera_without_follow(const ReconstructJob& job) {
  for (const auto& [sensor, pattern] : job.scan.frames)
    if (is_camera(pattern) && !job.follow)
      throw Error(fmt::format("{}: frames.{}", job.scan_file.string(), sensor), "is a camera",
                  "give --follow, or `lightstripe record` it first");
}

}  // namespace lightstripe
