// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// How densely a scan has sampled the surface: decides what is a gap and what is the next point.
#pragma once

#include <filesystem>

namespace lightstripe {

struct CloudSpacing {
  double along_stripe_mm = 0;    ///< median distance of neighbouring points of a stripe; 0: not known
  double between_frames_mm = 0;  ///< median distance of a point to the next frame of its sensor; 0: one frame
};

/// Reads the cloud once.
CloudSpacing cloud_spacing(const std::filesystem::path& cloud);

}  // namespace lightstripe
