// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A height map on disk: float TIFF, 16-bit PNG, intensity and sigma beside it, and what they mean (YAML).
#pragma once

#include <filesystem>

#include "reconstruct/height_map.h"

namespace lightstripe {

/// `path`: map.tif. Writes map.tif (float, mm, NaN missing), map.png (16 bits, 0 missing, else offset + scale
/// * value), map_intensity.tif, map_sigma.tif and map.yaml, which says scale, offset and what rows and
/// columns are. An Error for another extension than .tif or .tiff, or where nothing is known.
void write_height_map(const std::filesystem::path& path, const HeightMap& map);

/// Only the check of the name, for before the work begins.
void check_height_map_name(const std::filesystem::path& path);

}  // namespace lightstripe
