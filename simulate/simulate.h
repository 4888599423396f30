// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A known scene before a known rig -> what the cameras would see, as files that the other commands take, with
// the truth.
#pragma once

#include <filesystem>
#include <functional>

#include "simulate/scene.h"

namespace lightstripe {

struct SimulationSummary {
  int images = 0;
  std::filesystem::path session;  ///< calibration.yaml
  std::filesystem::path scan;     ///< scan.yaml
  std::filesystem::path
      truth;  ///< folder: rig.yaml, poses.csv, stripes.csv, sections.csv, wear.csv, README.md
};

/// Called after each image with (done, total), never from two threads at once.
using SimulationProgress = std::function<void(int, int)>;

/// Renders the scene's calibration session and scan into `output_folder`. Same scene, same bits, whatever the
/// number of threads (0 = all cores). Pictures of an earlier run that this one does not replace are removed
/// from its folders.
SimulationSummary simulate_scene(const Scene& scene, const std::filesystem::path& output_folder,
                                 int threads = 0, const SimulationProgress& progress = {});

}  // namespace lightstripe
