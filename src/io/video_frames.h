// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "io/images.h"

namespace lightstripe {

/// Frames of a video file. Opening decodes it once to count them: containers' own counts are estimates.
std::unique_ptr<FrameSource> open_video(const std::filesystem::path& path, Channel channel);

}  // namespace lightstripe
