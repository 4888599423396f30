// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The black and white cells of a marker, by OpenCV's dictionaries.
#pragma once

#include <string>
#include <vector>

namespace lightstripe {

struct MarkerCells {
  int side = 0;                ///< cells along a side, border included
  std::vector<bool> is_black;  ///< row by row
  bool black(int x, int y) const { return is_black[static_cast<std::size_t>(y * side + x)]; }
};

/// Throws an Error where OpenCV has no such dictionary, or the dictionary too few markers.
MarkerCells marker_cells(const std::string& dictionary, int id, int border_bits);

}  // namespace lightstripe
