// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The window of a point evaluation that reaches over the image's border.
#pragma once

#include <vector>

#include "core/image.h"

namespace lightstripe {

/// Where the window lies and how the image goes on beyond its border.
struct BorderWindow {
  int left = 0, top = 0;                ///< px, of the window's first pixel; may lie outside
  int taps = 0;                         ///< px, columns and rows that are filled
  int pitch = 0;                        ///< px from row to row of the copy
  double tangent_x = 0, tangent_y = 0;  ///< direction of the line; (0, 0): border pixels are repeated
};

/// A copy of the window: pixels beyond the border are taken from it, shifted along the tangent.
template <class T>
void fill_border_window(ImageView<T> image, const BorderWindow& place, std::vector<T>& window);

}  // namespace lightstripe
