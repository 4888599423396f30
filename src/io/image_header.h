// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What the bytes of a picture file say about it before anything is decoded: format, size, whether all of it
// is there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace lightstripe {

/// A picture of more pixels is refused before anything is allocated.
inline constexpr std::int64_t kMaxPixels = std::int64_t{1} << 28;

/// What to do with a damaged picture.
inline constexpr const char* kExportAgain = "record or export it again";

enum class ImageFormat { kUnknown, kPng, kJpeg, kTiff, kBmp, kPnm };

struct ImageHeader {
  ImageFormat format = ImageFormat::kUnknown;
  std::int64_t width = 0;   ///< px, 0 where the header does not tell
  std::int64_t height = 0;  ///< px
  int max_value = 0;        ///< PNM: the grey value that is white; others 0
  std::string
      damage;  ///< why the file cannot be whole ("ends before ..."), empty if nothing speaks against it
  std::size_t payload_at = 0;  ///< binary PNM: where the pixels begin
};

/// Looks at the structure only: chunks and their checksums (PNG), segments to the end marker (JPEG),
/// directory and strips (TIFF), payload (BMP, binary PNM).
ImageHeader inspect_image(std::string_view bytes);

}  // namespace lightstripe
