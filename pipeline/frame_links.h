// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// From a measured frame back to the pictures that it was measured in.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace lightstripe {

struct FrameLink {
  std::string sensor;
  std::string href;  ///< relative to the page where both lie on one disk, escaped for an attribute
};

/// The pictures of these frames that the scan file names, in the order of the rig's sensors; `rig_file`
/// instead of the scan's own, if not empty.
std::map<std::int64_t, std::vector<FrameLink>> frame_links(const std::string& scan_file,
                                                           const std::string& rig_file,
                                                           const std::filesystem::path& page,
                                                           const std::vector<std::int64_t>& frames);

/// A file as a page links to it, escaped; empty for an empty file.
std::string link_to(const std::filesystem::path& file, const std::filesystem::path& page);

}  // namespace lightstripe
