// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace lightstripe {

/// CRC-32 of ISO 3309 (PNG specification, annex D) over text that may come in parts:
/// crc32(b, crc32(a)) = crc32(a + b).
std::uint32_t crc32(std::string_view bytes, std::uint32_t before = 0);

}  // namespace lightstripe
