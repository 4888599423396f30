// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/board/laser_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace lightstripe {

Image8 laser_light(ImageView8 laser, ImageView8 board) {
  const AmbientChange change = fit_ambient_change(laser, board);
  std::array<int, 256> ambient{};
  for (int level = 0; level < 256; ++level)
    ambient[static_cast<std::size_t>(level)] =
        static_cast<int>(std::lround(change.gain * level + change.offset));
  Image8 light(laser.width, laser.height);
  for (int y = 0; y < laser.height; ++y)
    for (int x = 0; x < laser.width; ++x)
      light(x, y) =
          static_cast<std::uint8_t>(std::clamp(laser(x, y) - ambient[board(x, y)] + kDarkLevel, 0, 255));
  return light;
}

}  // namespace lightstripe
