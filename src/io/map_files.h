// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Maps as pictures: 32-bit float TIFF and 16-bit PNG.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace lightstripe {

/// One channel, row by row, as they are (NaN too).
void write_float_tiff(const std::filesystem::path& path, const std::vector<float>& values, int width,
                      int height);

/// One channel of 16 bits, PNG.
void write_grey16_png(const std::filesystem::path& path, const std::vector<std::uint16_t>& values, int width,
                      int height);

/// What write_float_tiff wrote; an Error where the file is something else.
std::vector<float> read_float_tiff(const std::filesystem::path& path, int* width, int* height);

}  // namespace lightstripe
