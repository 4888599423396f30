// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// One page of a many-page TIFF as a TIFF file of its own, so that it takes the same guarded way as every
// other picture. TIFF 6.0, section 2; BigTIFF: the same with 8-byte counts and offsets.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace lightstripe {

/// Reads `length` bytes at `offset` of a file; shorter where the file ends.
using ReadAt = std::function<std::string(std::uint64_t offset, std::uint64_t length)>;

struct TiffLayout {
  bool is_tiff = false;
  bool big_endian = false;
  bool big_tiff = false;
  std::uint64_t file_size = 0;
  std::vector<std::uint64_t> pages;  ///< offset of each page's directory, in the chain's order; where the
                                     ///< chain breaks the offset that leads nowhere is the last
};

/// Follows the chain of directories; a chain that bites its tail ends there.
TiffLayout read_tiff_layout(const ReadAt& read, std::uint64_t file_size);

/// The page as a file of the same byte order; an empty text where its directory or pixels are not all there.
std::string cut_tiff_page(const ReadAt& read, const TiffLayout& layout, std::uint64_t directory);

}  // namespace lightstripe
