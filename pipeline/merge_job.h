// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The job of `lightstripe merge`: parts of a scan (reconstruct --frames A:B) -> the files that one run over
// all frames would have written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace lightstripe {

struct MergeJob {
  /// Clouds (.ply, .pcd, .xyz) or tables of sections (.csv), in any order; .xyz: in order of frames.
  std::vector<std::filesystem::path> parts;
  std::filesystem::path output;  ///< of the same extension
};

struct MergeResult {
  std::int64_t num_points = 0;  ///< of .ply and .pcd; the other formats do not say
  std::vector<std::string> warnings{};
};

/// Writes the joined file and the run's record (<output>.run.yaml); that of sections names their rig, if all
/// parts were made with the same one. An Error where a part cannot be read, has
/// another format, or has frames in common with another one.
MergeResult merge(const MergeJob& job);

}  // namespace lightstripe
