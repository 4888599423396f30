// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A recorded scan on disk + rig -> cloud and profiles on disk.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "apps/command.h"
#include "extraction/extract_stripes.h"
#include "pipeline/scan_journal.h"
#include "reconstruct/scanner.h"

namespace lightstripe {

struct ReconstructArguments {
  CommonOptions common;
  std::string scan;
  std::string rig;       ///< empty: as the scan says
  std::string profiles;  ///< empty: not written
  std::string preview;   ///< empty: not drawn
  std::string frames;    ///< "A:B": frames A to B - 1; either may be left out
  bool strict = false;   ///< a picture that is missing or cannot be read ends the run
  bool resume = false;   ///< go on where an earlier run was ended
  double checkpoint_s = 1;
  bool dry_run = false;  ///< only tell which frames there are
  Overrides extraction;
};

struct ReconstructOutcome {
  ScanSummary summary;
  std::vector<NamedSkip> skipped;               ///< the first of them
  std::vector<std::string> duplicate_pictures;  ///< pictures whose number another one has
  std::int64_t first_frame = 0, end_frame = 0;
  std::int64_t frames_now = 0;  ///< of this run, without those of the one that it went on from
  double seconds = 0;
  int brightest = 0;          ///< where nothing was found: largest grey level of some pictures
  std::string partial_cloud;  ///< where the part is that was done before the run was interrupted
};

/// First frame and the one behind the last that a run with these arguments would scan.
std::pair<std::int64_t, std::int64_t> frames_to_reconstruct(const ReconstructArguments& arguments);

/// Reads, reconstructs and writes. Files appear under their names only when all went well and there are
/// points; an interrupted run (Ctrl-C) leaves them under partial names, and says so by summary.stopped.
ReconstructOutcome reconstruct_scan(const ReconstructArguments& arguments);

}  // namespace lightstripe
