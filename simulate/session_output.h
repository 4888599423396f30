// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The files around the images: folders, calibration.yaml, scan.yaml, travel tables, truth.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/rig.h"
#include "simulate/image_plan.h"
#include "simulate/simulate.h"

namespace lightstripe {

/// Makes the images' folders and removes from them pictures of the simulator's names (digits.png) that this
/// plan does not write: an earlier, longer run would otherwise leave frames that the session's patterns
/// catch.
void make_folders(const ImagePlan& plan, const std::filesystem::path& output_folder);

/// The folder truth/. `stripes`: the rows of each image.
void write_truth(const std::filesystem::path& folder, const Scene& scene, const ImagePlan& plan,
                 const Rig& rig, const std::vector<std::string>& stripes);

/// calibration.yaml (if the scene has boards), scan.yaml (if it has frames) and their travel tables.
SimulationSummary write_session(const std::filesystem::path& output_folder, const Scene& scene,
                                const ImagePlan& plan);

}  // namespace lightstripe
