// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A cloud as a map: heights on a regular raster, with the light's intensity and the predicted error.
#pragma once

#include <filesystem>
#include <vector>

#include "core/rig.h"

namespace lightstripe {

struct HeightMapOptions {
  double raster_mm = 1;  ///< between neighbouring pixels, both ways; rotary: on the median radius
  double bridge_mm = 0;  ///< gaps within a stripe up to this length are closed by a straight line
  double same_surface_mm =
      0.5;  ///< heights of two sensors closer than this are averaged, else the higher counts
};

/// Columns along x (rotary: angle about the axis from the rig's z, right-handed), rows along y (rotary:
/// along the axis), heights are z (rotary: radius). Missing pixels are NaN in all three planes.
struct HeightMap {
  int width = 0, height = 0;
  bool rotary = false;
  double column_first = 0, column_step = 0;  ///< mm, or degrees
  double row_first = 0, row_step = 0;        ///< mm
  double height_origin = 0;                  ///< mm, what the heights count from (the cloud's origin)
  std::vector<float> heights;                ///< mm, row by row
  std::vector<float> intensity;              ///< grey levels
  std::vector<float> sigma;                  ///< mm
};

/// Each stripe is sampled where the raster's rows cross it, between its two neighbouring points; then each
/// row is sampled at the raster's columns, between neighbouring frames. Nothing is binned, so that no stripes
/// arise, and nothing is filled beyond that: points farther apart than three usual spacings (or bridge_mm)
/// are not neighbours, nor are frames farther apart than one and a half usual steps. Across an edge (steeper
/// than 1:2 between two frames) the nearer frame counts. Where several surfaces lie above each other the
/// highest counts. An Error for more than 2^28 pixels.
HeightMap make_height_map(const std::filesystem::path& cloud, const Motion& motion,
                          const HeightMapOptions& options);

}  // namespace lightstripe
