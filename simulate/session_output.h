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

/// What a simulation may write besides its pictures, relative to its folder.
std::vector<std::string> session_files();

/// Makes the images' folders and removes what an earlier, longer run has written, which the session's
/// patterns would catch. Only what the folder's marker file (.lightstripe-simulation) names is replaced or
/// deleted: an Error where a file or a picture of somebody else lies there, before anything is touched.
void make_folders(const ImagePlan& plan, const std::filesystem::path& output_folder);

/// Behind the last file, or where the disk was full: the marker names what is there.
void close_folders(const std::filesystem::path& output_folder);

/// The folder truth/. `stripes`: the rows of each image.
void write_truth(const std::filesystem::path& folder, const Scene& scene, const ImagePlan& plan,
                 const Rig& rig, const std::vector<std::string>& stripes);

/// calibration.yaml (if the scene has boards), scan.yaml (if it has frames) and their travel tables.
SimulationSummary write_session(const std::filesystem::path& output_folder, const Scene& scene,
                                const ImagePlan& plan);

}  // namespace lightstripe
