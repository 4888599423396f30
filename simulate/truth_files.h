// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The truth beside the pictures: what a perfect calibration and reconstruction would find. Columns:
// truth/README.md, which write_truth_readme() writes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/rig.h"
#include "simulate/exposure.h"
#include "simulate/scene.h"
#include "simulate/scene_world.h"
#include "simulate/stripe_truth.h"

namespace lightstripe {

/// A board's pose by the name of its images.
struct NamedPose {
  std::string name;
  Rigid3 rig_from_board;
};

inline constexpr std::string_view kStripeTruthHeader = "image,sensor,frame,x,y,X,Y,Z,level,blob\n";

/// The rows of one image. `frame` is -1 outside the scan; blob = 1 where reflections add more than 2 grey
/// levels.
std::string stripe_rows(const std::string& image, const std::string& sensor, int frame,
                        const std::vector<StripeTruth>& points, const Rigid3& rig_from_world,
                        const std::vector<Blob>& blobs, const Reflections& plan);

void write_poses(const std::filesystem::path& path, const std::vector<NamedPose>& poses);

/// sections.csv and wear.csv, one section a frame; of a track's second rail other_sections.csv and
/// other_wear.csv. Without a rail or a wheel none is written.
void write_sections(const std::filesystem::path& folder, const Scene& scene, const NominalOutlines& nominal,
                    const Rig& rig, const Rigid3& rig_from_world);

void write_truth_readme(const std::filesystem::path& path);

}  // namespace lightstripe
