// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// poses.csv: accepted rotations are rotations.

#include <cmath>
#include "fuzz_input.h"

#include "core/error.h"
#include "io/tables.h"

namespace lightstripe::fuzz {

const std::string_view kExtension = ".csv";

void read_input(const std::filesystem::path& file) {
  for (const auto& [frame, pose] : read_poses(file))
    LIGHTSTRIPE_CHECK(std::abs(pose.rotation.norm() - 1) < 1e-12, "an accepted rotation has unit length");
}

}  // namespace lightstripe::fuzz
