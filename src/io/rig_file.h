// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// rig.yaml: the calibrated rig on disk (docs/interface.md, "rig.yaml").
#pragma once

#include <filesystem>
#include <string>

#include "core/rig.h"

namespace lightstripe {

/// A rig that scans needs laser planes; one that gives its cameras need not have them (`laser: none`).
enum class RigUse { kScans, kCameras };

/// Reads and checks: format tag, finite numbers, focal lengths > 0, unit normals and quaternions (to 1e-6,
/// then made exact), distortion with 4, 5, 8, 12 or 14 terms that is invertible over the image. An Error
/// names file and key.
Rig read_rig(const std::filesystem::path& path, RigUse use = RigUse::kScans);

/// The text of rig.yaml; every number with as many digits as it takes to read back the same bits. Distortion
/// is written with 5, 8, 12 or 14 terms, whatever it takes; sigmas that are not finite are left out.
std::string rig_to_yaml(const Rig& rig);

}  // namespace lightstripe
