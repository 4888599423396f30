// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "io/images.h"

namespace lightstripe {

/// The pages of a TIFF or BigTIFF file as frames, one page in memory at a time; nothing for a file of one
/// page, which is a picture like any other. An Error where the file is no TIFF or its chain of pages is
/// broken at the first.
std::unique_ptr<FrameSource> open_tiff_pages(const std::filesystem::path& path, Channel channel);

}  // namespace lightstripe
