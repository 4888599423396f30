// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A calibration picture with the corners and the stripe that were found in it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "pipeline/observe_session.h"

namespace lightstripe {

struct OverlayPicture {
  std::vector<std::uint8_t> rgb;
  int width = 0, height = 0;
};

/// The board's picture (or where the laser has one of its own, the brighter of both at each pixel) with
/// corners, rows in order, and stripe points; not wider than `max_width_px` (0: full size).
OverlayPicture draw_board(const SeenPicture& picture, int max_width_px);

/// Every picture as a PNG: <folder>/<sensor>/<image>.png; of pictures with the same name in two folders the
/// second gets its folder's before it.
void write_overlays(const std::filesystem::path& folder, const std::vector<SeenPicture>& pictures);

}  // namespace lightstripe
