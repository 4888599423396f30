// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A recorded scan on disk + rig -> cloud and profiles on disk.
#pragma once

#include <string>

#include "apps/command.h"
#include "extraction/extract_stripes.h"
#include "reconstruct/scanner.h"

namespace lightstripe {

struct ReconstructArguments {
  CommonOptions common;
  std::string scan;
  std::string rig;       ///< empty: as the scan says
  std::string profiles;  ///< empty: not written
  std::string preview;   ///< empty: not drawn
  Overrides extraction;
};

struct ReconstructOutcome {
  ScanSummary summary;
  double seconds = 0;
};

/// Reads, reconstructs and writes; files appear only when all went well and there are points.
ReconstructOutcome reconstruct_scan(const ReconstructArguments& arguments);

}  // namespace lightstripe
