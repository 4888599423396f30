// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The job of `lightstripe verify`: new pictures of a board and a rig on disk -> how far the rig is off.
#pragma once

#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

#include "calib/verify/verify_rig.h"
#include "core/rig.h"
#include "extraction/options.h"
#include "io/session_file.h"
#include "pipeline/job.h"
#include "pipeline/observe_session.h"

namespace lightstripe {

struct VerifyJob {
  std::filesystem::path session_file, rig_file;  ///< named in messages and in the run's record
  Session session;                               ///< with pictures that the rig was not calibrated with
  Rig rig;
  ExtractionOptions extraction;                ///< in effect: the session's own are merged
  VerifyLimits limits;                         ///< what the errors must not exceed
  std::filesystem::path table = "verify.csv";  ///< of the views; empty: not written
  int threads = 0;                             ///< 0 = all cores
};

/// The job as the files describe it; what else is wanted is set in it afterwards.
VerifyJob read_verify_job(const std::filesystem::path& session_file, const std::filesystem::path& rig_file);

struct VerifyResult {
  SessionObservations seen;
  Verification verification;
  bool measured = false;                ///< some view shows board and stripe; without, nothing is written
  std::vector<std::string> exceeded{};  ///< each limit that is exceeded, as a sentence
  std::string not_usable;               ///< why the rig fails or cannot be judged; empty: it passes
  bool usable() const { return not_usable.empty(); }
};

/// Looks at the session's pictures, compares them with the rig, and writes the table and the run's record
/// (<table>.run.yaml). An Error where a file is wrong, session and rig do not fit each other, or a stop was
/// asked for.
VerifyResult verify(const VerifyJob& job, const ProgressCallback& progress = {},
                    const std::stop_token& stop = {});

}  // namespace lightstripe
