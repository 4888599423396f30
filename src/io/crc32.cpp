// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/crc32.h"

#include <array>
#include <cstddef>

namespace lightstripe {
namespace {

/// Eight tables, for eight bytes a step ("slicing by 8").
class Tables {
 public:
  constexpr Tables() {
    for (std::uint32_t n = 0; n < 256; ++n) {
      std::uint32_t c = n;
      for (int bit = 0; bit < 8; ++bit) c = (c & 1U) != 0 ? 0xedb88320U ^ (c >> 1) : c >> 1;
      table_.at(0).at(n) = c;
    }
    for (std::size_t slice = 1; slice < 8; ++slice)
      for (std::size_t n = 0; n < 256; ++n) {
        const std::uint32_t c = table_.at(slice - 1).at(n);
        table_.at(slice).at(n) = table_[0][c & 0xffU] ^ (c >> 8);
      }
  }
  constexpr const std::array<std::uint32_t, 256>& operator[](std::size_t slice) const {
    return table_[slice];
  }

 private:
  std::array<std::array<std::uint32_t, 256>, 8> table_{};
};

constexpr Tables kTables;

}  // namespace

std::uint32_t crc32(std::string_view bytes, std::uint32_t before) {
  const Tables& table = kTables;
  std::uint32_t c = ~before;
  const auto* p = reinterpret_cast<const unsigned char*>(bytes.data());
  std::size_t left = bytes.size();
  for (; left >= 8; left -= 8, p += 8) {
    c ^= std::uint32_t{p[0]} | std::uint32_t{p[1]} << 8 | std::uint32_t{p[2]} << 16 |
         std::uint32_t{p[3]} << 24;
    c = table[7][c & 0xffU] ^ table[6][c >> 8 & 0xffU] ^ table[5][c >> 16 & 0xffU] ^ table[4][c >> 24] ^
        table[3][p[4]] ^ table[2][p[5]] ^ table[1][p[6]] ^ table[0][p[7]];
  }
  for (; left > 0; --left, ++p) c = table[0][(c ^ *p) & 0xffU] ^ (c >> 8);
  return ~c;
}

}  // namespace lightstripe
