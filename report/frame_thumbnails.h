// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The pictures of a frame, small, with the reconstructed line drawn where the rig says that it was seen.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/profile.h"

namespace lightstripe {

struct FrameThumbnail {
  std::string sensor;
  std::string href;  ///< the picture, as seen from the page
  std::vector<std::uint8_t> jpeg;
};

/// Of each of the profiles that the scan has pictures of, by frame. The points go back through travel, rig
/// and lens to the image: a line that lies beside the stripe shows a rig that has moved.
std::map<std::int64_t, std::vector<FrameThumbnail>> frame_thumbnails(
    const std::filesystem::path& scan_file, const std::filesystem::path& rig_file,
    const std::filesystem::path& page, const std::vector<const Profile*>& profiles);

}  // namespace lightstripe
