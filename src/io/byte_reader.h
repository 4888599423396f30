// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Whole numbers out of a file's bytes; reading beyond the end gives 0 and is remembered.
#pragma once

#include <cstdint>
#include <string_view>

namespace lightstripe {

struct ByteReader {
  std::string_view bytes;
  bool big_endian = false;
  bool beyond_end = false;

  std::uint64_t number(std::uint64_t position, int length) {
    const auto count = static_cast<std::uint64_t>(length);
    if (position > bytes.size() || bytes.size() - position < count) {
      beyond_end = true;
      return 0;
    }
    std::uint64_t value = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::uint64_t at = big_endian ? position + i : position + count - 1 - i;
      value = value << 8 | static_cast<unsigned char>(bytes[at]);
    }
    return value;
  }
  std::uint64_t u8(std::uint64_t position) { return number(position, 1); }
  std::uint64_t u16(std::uint64_t position) { return number(position, 2); }
  std::uint64_t u32(std::uint64_t position) { return number(position, 4); }
  std::int64_t i32(std::uint64_t position) { return static_cast<std::int32_t>(u32(position)); }
};

}  // namespace lightstripe
