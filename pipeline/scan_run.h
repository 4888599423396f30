// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A reconstruct job whose frames are known: what it reads, where it begins, how its output is described.
#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>

#include "pipeline/reconstruct_job.h"
#include "pipeline/recording.h"
#include "pipeline/scan_output.h"

namespace lightstripe {

struct ScanRun {
  const ReconstructJob& job;
  Recording recording;
  std::int64_t first_frame, end_frame;
};

/// Opens the job's recording. An Error where it has none of the wanted frames.
ScanRun open_run(const ReconstructJob& job);

/// What the cloud's coordinates count from, mm.
Eigen::Vector3d origin_of(const ScanRun& run);

/// How the output is opened: its names, and the fingerprint of everything that its bytes depend on.
ScanOutputOptions output_options(const ScanRun& run);

/// From the first frame that `output` does not have to the run's last. Both must outlive the input.
ScanInput scan_input(const ScanRun& run, const ScanOutput& output, const std::stop_token& stop);

/// With `strict`: what would be left out is an error before anything is done.
void refuse_vanished_frames(const ScanRun& run);

/// Tells the points that an earlier run has left in its cloud, one a call.
void tell_earlier_points(const std::filesystem::path& cloud, const Eigen::Vector3d& origin,
                         std::int64_t num_points, const std::function<void(const Profile&)>& tell);

/// Largest grey level, of 8 bits, of the first pictures that can be read; 255 for those of 16 bits.
int brightest_level(const ScanRun& run);

}  // namespace lightstripe
