// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A known scene before a known rig -> what the cameras would see, as files that the other commands take, with the truth.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace lightstripe {

struct SimulationSummary {
  int images = 0;
  std::filesystem::path session;  ///< calibration.yaml
  std::filesystem::path scan;     ///< scan.yaml
  std::filesystem::path truth;    ///< folder: rig.yaml, poses.csv, stripes.csv, sections.csv
};

// (implementation: the simulate owner completes this header: Scene, visit_fields, simulate_scene)

}  // namespace lightstripe
