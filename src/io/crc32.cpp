// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/crc32.h"

#include <libdeflate.h>

namespace lightstripe {

std::uint32_t crc32(std::string_view bytes, std::uint32_t before) {
  if (bytes.empty()) return before;  // a null pointer would ask libdeflate for the start value
  return libdeflate_crc32(before, bytes.data(), bytes.size());
}

}  // namespace lightstripe
