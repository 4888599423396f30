// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What the pictures with drawn lines are called: asked before anything is written, and when they are.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace lightstripe {

/// <folder>/<image's name>.png for each image. Images of the same name from several folders are kept apart by
/// their folder's name in front, or by a number.
std::vector<std::filesystem::path> overlay_files(const std::vector<std::string>& images,
                                                 const std::filesystem::path& folder);

/// The same for a session's board pictures (sensor and file), each in the folder of its sensor.
std::vector<std::filesystem::path> board_overlay_files(
    const std::vector<std::pair<std::string, std::filesystem::path>>& boards,
    const std::filesystem::path& folder);

}  // namespace lightstripe
