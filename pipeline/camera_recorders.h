// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Cameras that a scan file names in place of pictures: recorded beside the cloud while the scan follows them.
#pragma once

#include <exception>
#include <mutex>
#include <stop_token>
#include <thread>
#include <vector>

#include "pipeline/reconstruct_job.h"

namespace lightstripe {

class CameraRecorders {
 public:
  /// Records the job's cameras to <cloud's stem>.frames/<sensor>/ while it lives; the job then names these
  /// folders.
  explicit CameraRecorders(ReconstructJob& job);
  CameraRecorders(const CameraRecorders&) = delete;
  CameraRecorders& operator=(const CameraRecorders&) = delete;

  /// Asked for when a recorder has failed.
  std::stop_token failed() const { return failed_.get_token(); }
  /// Ends the recording; throws what went wrong with it.
  void end();

 private:
  std::mutex mutex_;
  std::exception_ptr error_;
  std::stop_source failed_;
  std::vector<std::jthread> threads_;
};

/// An Error where the job names a camera but does not follow.
void refuse_camera_without_follow(const ReconstructJob& job);

}  // namespace lightstripe
