// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/png_grey.h"

#include <libdeflate.h>

#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "io/byte_reader.h"

namespace lightstripe {
namespace {

using Byte = std::uint8_t;

struct PngParts {
  int width = 0, height = 0, bytes_per_pixel = 0;
  std::string_view deflated;  ///< all of IDAT
  std::string joined;         ///< holds it where it came in several chunks
};

/// Nothing where the picture is not plain grey.
std::optional<PngParts> grey_parts_of(std::string_view bytes) {
  ByteReader in{bytes, true};
  const std::uint64_t depth = in.u8(24), color_type = in.u8(25), interlaced = in.u8(28);
  if ((depth != 8 && depth != 16) || color_type != 0 || interlaced != 0) return std::nullopt;
  PngParts parts;
  parts.width = static_cast<int>(in.u32(16));
  parts.height = static_cast<int>(in.u32(20));
  parts.bytes_per_pixel = static_cast<int>(depth / 8);
  for (std::uint64_t at = 8; !in.beyond_end;) {
    const std::uint64_t length = in.u32(at);
    const std::string_view type = bytes.substr(at + 4, 4);
    if (type == "tRNS") return std::nullopt;
    if (type == "IEND") break;
    if (type == "IDAT" && parts.deflated.empty())
      parts.deflated = bytes.substr(at + 8, length);
    else if (type == "IDAT")
      parts.joined += parts.joined.empty() ? std::string(parts.deflated).append(bytes.substr(at + 8, length))
                                           : std::string(bytes.substr(at + 8, length));
    at += 12 + length;
  }
  return parts;
}

/// The rows, each behind the byte that names its filter; nothing where they do not fill the picture exactly.
std::optional<std::vector<Byte>> inflated(const PngParts& parts, std::size_t size) {
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> decompressor(
      libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  if (!decompressor) return std::nullopt;
  const std::string_view deflated = parts.joined.empty() ? parts.deflated : std::string_view(parts.joined);
  std::vector<Byte> rows(size);
  const auto result = libdeflate_zlib_decompress(decompressor.get(), deflated.data(), deflated.size(),
                                                 rows.data(), size, nullptr);
  return result == LIBDEFLATE_SUCCESS ? std::optional(std::move(rows)) : std::nullopt;
}

Byte paeth(int left, int above, int corner) {
  const int from_left = std::abs(above - corner), from_above = std::abs(left - corner);
  const int from_corner = std::abs(left + above - 2 * corner);
  if (from_left <= from_above && from_left <= from_corner) return static_cast<Byte>(left);
  return static_cast<Byte>(from_above <= from_corner ? above : corner);
}

/// Undoes a row's filter in place. `above`: the row before, undone; zeros for the first. False for an unknown
/// one.
template <std::size_t kStep>
bool undo_filter(int filter, Byte* row, const Byte* above, std::size_t length) {
  switch (filter) {
    case 0:
      return true;
    case 1:
      for (std::size_t i = kStep; i < length; ++i) row[i] = static_cast<Byte>(row[i] + row[i - kStep]);
      return true;
    case 2:
      for (std::size_t i = 0; i < length; ++i) row[i] = static_cast<Byte>(row[i] + above[i]);
      return true;
    case 3:
      for (std::size_t i = 0; i < length; ++i)
        row[i] = static_cast<Byte>(row[i] + ((i >= kStep ? row[i - kStep] : 0) + above[i]) / 2);
      return true;
    case 4:
      for (std::size_t i = 0; i < length; ++i)
        row[i] = static_cast<Byte>(row[i] + (i >= kStep ? paeth(row[i - kStep], above[i], above[i - kStep])
                                                        : paeth(0, above[i], 0)));
      return true;
    default:
      return false;
  }
}

template <class T>
std::optional<GreyImage> picture_of(const PngParts& parts) {
  const auto width = static_cast<std::size_t>(parts.width), height = static_cast<std::size_t>(parts.height);
  const std::size_t length = width * sizeof(T), pitch = length + 1;
  auto rows = inflated(parts, pitch * height);
  if (!rows) return std::nullopt;
  Image<T> image;
  image.width = parts.width;
  image.height = parts.height;
  image.pixels.reserve(width * height);
  const std::vector<Byte> zeros(length, 0);
  const Byte* above = zeros.data();
  for (std::size_t y = 0; y < height; ++y) {
    Byte* row = rows->data() + y * pitch + 1;
    if (!undo_filter<sizeof(T)>(row[-1], row, above, length)) return std::nullopt;
    above = row;
    if constexpr (sizeof(T) == 1)
      image.pixels.insert(image.pixels.end(), row, row + length);
    else
      for (std::size_t x = 0; x < length; x += 2)
        image.pixels.push_back(static_cast<T>(row[x] << 8 | row[x + 1]));
  }
  return image;
}

}  // namespace

std::optional<GreyImage> decode_grey_png(std::string_view bytes) {
  const auto parts = grey_parts_of(bytes);
  if (!parts) return std::nullopt;
  return parts->bytes_per_pixel == 1 ? picture_of<Byte>(*parts) : picture_of<std::uint16_t>(*parts);
}

}  // namespace lightstripe
