// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// One file that grows picture by picture: a BigTIFF without compression, whose pages appear when they are
// whole.
#pragma once

#include <cstdint>
#include <filesystem>

#include "core/image.h"

namespace lightstripe {

class GrowingTiff {
 public:
  /// Begins the file anew; an Error where it cannot be written, or is there already.
  explicit GrowingTiff(const std::filesystem::path& path);
  ~GrowingTiff();
  GrowingTiff(const GrowingTiff&) = delete;
  GrowingTiff& operator=(const GrowingTiff&) = delete;

  /// Appends a page of 8 or 16 bits: first its pixels and its directory, then the link to it, so that a
  /// reader, and a program that is killed, never meet half a page. An Error names the file (disk full); the
  /// pages before stay.
  void append(const GreyImage& image);
  std::int64_t pages() const { return pages_; }

 private:
  void write_at(std::uint64_t offset, const void* bytes, std::size_t count);

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t end_ = 16;  ///< of the file, bytes
  std::uint64_t link_ = 8;  ///< where the next page's directory is to be named
  std::int64_t pages_ = 0;
};

}  // namespace lightstripe
