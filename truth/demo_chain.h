// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The demo's steps on a rendered scene, each from files to files in one folder: calibrate, reconstruct,
// measure, and what is drawn of them.
#pragma once

#include <filesystem>
#include <set>
#include <stop_token>
#include <string>
#include <vector>

#include "pipeline/calibrate_job.h"
#include "pipeline/reconstruct_job.h"
#include "simulate/simulate.h"
#include "truth/compare_with_truth.h"

namespace lightstripe {

/// The files that the demo writes into its folder, the rendered ones left out.
std::set<std::string> demo_files(const Scene& scene);

/// rig.yaml and calibration.html.
CalibrateResult calibrate_rendered(const SimulationSummary& simulated, const std::filesystem::path& folder,
                                   int threads);

/// Cloud, sections, preview, page, height map and mesh, by the folder's rig.yaml.
ReconstructResult reconstruct_rendered(const SimulationSummary& simulated,
                                       const std::filesystem::path& folder, int threads,
                                       const std::stop_token& stop);

/// overview.png: the middle frame of each sensor with its lines (also in overlay/), above the cloud.
void write_overview(const std::filesystem::path& scan, const std::vector<Profile>& profiles,
                    const std::filesystem::path& folder);

struct MeasuredWear {
  std::vector<QuantityError> errors;  ///< against the truth; empty where nothing could be measured
  std::vector<std::string> warnings;
};

/// measurements.csv and measure.html; nothing where the scene has neither rail nor wheel.
MeasuredWear measure_rendered(const Scene& scene, const SimulationSummary& simulated,
                              const std::filesystem::path& folder, int threads);

/// Where everything is, for people.
std::string list_demo_files(const std::filesystem::path& folder, bool measured);

}  // namespace lightstripe
