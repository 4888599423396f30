// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Pictures whose pixels lie in their file as they are needed: looked at there, nothing is copied.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>

#include "core/picture.h"
#include "io/images.h"

namespace lightstripe {

/// A file mapped into memory for reading; it has to stay as long as it is for all that time.
class MappedFile {
 public:
  /// Nothing where the file cannot be mapped (missing, empty, a pipe).
  static std::shared_ptr<const MappedFile> open(const std::filesystem::path& path);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::string_view bytes() const { return {data_, size_}; }
  /// Whether the middle of these bytes of the file is in memory already.
  bool is_cached(std::string_view part) const;
  /// Asks the system to read bytes of the file soon, and does not wait; what lies beyond its end is nothing.
  void read_ahead(std::uint64_t begin, std::uint64_t length) const;

 private:
  MappedFile(const char* data, std::size_t size) : data_(data), size_(size) {}
  char* page_of(std::uint64_t at) const;
  const char* data_;
  std::size_t size_;
};

/// Grey pixels of 8 bits in a file's bytes: binary PNM with a white of 255, BMP with a palette of greys,
/// TIFF and BigTIFF without compression whose strips lie one behind the other. Nothing for every other file,
/// also for one that is damaged.
std::optional<ImageView8> find_plain_pixels(std::string_view bytes);
/// The same for the TIFF page whose directory begins there.
std::optional<ImageView8> find_tiff_pixels(std::string_view bytes, std::uint64_t directory);

/// The picture where it lies; nothing where it has to be decoded, or is refused by read_grey_image().
std::optional<Picture> map_picture(const std::filesystem::path& path, Channel channel);

/// Asks the system to read the file soon (from a slow disk), and does not wait.
void read_ahead(const std::filesystem::path& path);

}  // namespace lightstripe
