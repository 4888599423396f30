// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// TIFF 6.0, section 8 "Baseline Field Reference Guide" and section 15 "Tiled Images".
#pragma once

#include <cstdint>

namespace lightstripe {

enum TiffTag : std::uint64_t {
  kTiffWidth = 256,
  kTiffHeight = 257,
  kTiffStripOffsets = 273,
  kTiffStripByteCounts = 279,
  kTiffTileWidth = 322,
  kTiffTileOffsets = 324,
  kTiffTileByteCounts = 325,
};

}  // namespace lightstripe
