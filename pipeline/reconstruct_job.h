// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The job of `lightstripe reconstruct`: a recorded scan and a rig on disk -> cloud and sections on disk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "core/profile.h"
#include "core/rig.h"
#include "extraction/options.h"
#include "io/session_file.h"
#include "pipeline/job.h"
#include "pipeline/scan_journal.h"
#include "pipeline/scan_lines.h"
#include "reconstruct/scanner.h"

namespace lightstripe {

struct ReconstructJob {
  std::filesystem::path scan_file, rig_file;  ///< named in messages and in the run's record
  Scan scan;
  Rig rig;
  ExtractionOptions extraction = scan_extraction();  ///< in effect: the scan's own are merged
  std::filesystem::path cloud = "cloud.ply";         ///< .ply, .pcd or .xyz
  std::filesystem::path profiles;                    ///< table of the sections (.csv); empty: none
  std::vector<std::filesystem::path> other_outputs;  ///< what else is written: must not be an input either
  std::optional<std::int64_t> first_frame;           ///< nothing: the recording's first
  std::optional<std::int64_t> end_frame;  ///< the first frame that is not done; nothing: to the end
  bool strict = false;      ///< a picture that is missing or cannot be read is an Error, not skipped
  bool resume = false;      ///< go on where an earlier run of the same job was ended
  double checkpoint_s = 1;  ///< time between the places where a run can be resumed
  int threads = 0;          ///< 0 = all cores
  bool follow =
      false;          ///< the recording is still being written: go on until it is over or a stop is asked for
  double idle_s = 0;  ///< follow: over when nothing has come for so long; 0: not by that
  /// Told of each section in order of frames, from one thread at a time. With `resume` the earlier run's
  /// points come first, read back from its cloud, one point a call.
  std::function<void(const Profile&)> on_profile{};
  /// Called when the files have their final names: for what else belongs beside them. After an exception of
  /// this the run can be resumed.
  std::function<void()> before_end{};
};

/// The job as the scan file describes it; what else is wanted is set in it afterwards. `rig_file` instead of
/// the one that the scan names, if not empty.
ReconstructJob read_reconstruct_job(const std::filesystem::path& scan_file,
                                    const std::filesystem::path& rig_file = {});

/// The first frame of the job and the one behind its last.
std::pair<std::int64_t, std::int64_t> frames_to_reconstruct(const ReconstructJob& job);

struct ReconstructResult {
  ScanSummary summary;
  std::vector<NamedSkip> skipped;               ///< the first of them
  std::vector<std::string> duplicate_pictures;  ///< pictures whose number another one has
  std::vector<std::string> warnings;            ///< of the recording: see Recording::warnings()
  FrameRanges without_picture;                  ///< frames of the table before or behind all pictures
  std::vector<SensorLines> lines;               ///< of this run, one a sensor
  std::vector<std::string> outside_range;       ///< a sentence for each sensor: see outside_range_texts()
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< what the cloud's coordinates count from, mm
  std::int64_t first_frame = 0, end_frame = 0;
  std::int64_t frames_now = 0;          ///< of this run, without those of the one that it went on from
  double seconds = 0;                   ///< of this run
  int brightest = 0;                    ///< where nothing was found: largest grey level of some pictures
  std::filesystem::path partial_cloud;  ///< where the part is that was done before the run was stopped
  std::string not_usable;               ///< why, and what to do; empty: the files are written
  bool usable() const { return not_usable.empty(); }
};

/// Reads, reconstructs and writes, with the run's record (<cloud>.run.yaml; <profiles>.run.yaml names the
/// rig). Files appear under their names
/// only when all went well and there are points; a run that was stopped leaves them under partial names, from
/// where one with `resume` goes on. An Error where a file is wrong.
///
/// With `follow` the recording may grow, begin with nothing, and be a camera (its pictures are then recorded
/// to <cloud's stem>.frames/<sensor>/). Frames are done once all sensors and the travel table have them; it
/// is over when `lightstripe record` has ended (record.yaml), after `idle_s`, or by the stop, which here is
/// no interruption: what has come is done and the files take their names.
ReconstructResult reconstruct(const ReconstructJob& job, const ProgressCallback& progress = {},
                              const std::stop_token& stop = {});

}  // namespace lightstripe
