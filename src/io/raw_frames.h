// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Frames that are nothing but pixels, as cameras' own programs save them:
// "raw:scan/*.raw?width=960&height=700".
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "io/images.h"

namespace lightstripe {

bool is_raw(const std::string& frames);

/// What a scan's `frames:` names, as a pattern of files: without "raw:" and its options.
std::string files_of_frames(const std::string& frames);

/// Options: width and height, px; bits, 8 (default) or 16 (the low byte first); skip, bytes before the first
/// frame of each file (0). A file holds one frame or several, one behind the other; what is left of one is a
/// frame that cannot be read. Frames of 8 bits are looked at where they lie. An Error where an option is
/// missing, unknown or no such number.
std::unique_ptr<FrameSource> open_raw_frames(const std::filesystem::path& base, const std::string& frames);

}  // namespace lightstripe
