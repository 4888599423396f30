// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/compare/derivative_planes.h"

#include <cmath>

namespace lightstripe {

template <class T>
void find_lines_in_planes(ImageView<T> image, const DerivativeKernels& kernels, const RidgeLimits& limits,
                          WholeImageWorkspace& workspace, LineSet& lines) {
  const DerivativePlanes& planes = workspace.planes;
  LinePointMap& map = workspace.map;
  map.reset(image.width, image.height);
  for (int y = 0; y < image.height; ++y) {
    const float *rx = planes.dx.row(y), *ry = planes.dy.row(y), *rxx = planes.dxx.row(y),
                *rxy = planes.dxy.row(y), *ryy = planes.dyy.row(y);
    for (int x = 0; x < image.width; ++x) {
      // The eigenvalue's magnitude is at most |rxx| + 2 |rxy| + |ryy|: most of the image ends here.
      if (std::abs(rxx[x]) + std::abs(ryy[x]) + 2 * std::abs(rxy[x]) < limits.follow_strength) continue;
      if (limits.hard_levels && image(x, y) < limits.level_low) continue;
      map.test_pixel(x, y, {0, rx[x], ry[x], rxx[x], rxy[x], ryy[x]}, limits.follow_strength);
    }
  }
  link_points(map, limits.start_strength, lines);
  refine_points(image, kernels, lines);
}

template void find_lines_in_planes<std::uint8_t>(ImageView8, const DerivativeKernels&, const RidgeLimits&,
                                                 WholeImageWorkspace&, LineSet&);
template void find_lines_in_planes<std::uint16_t>(ImageView16, const DerivativeKernels&, const RidgeLimits&,
                                                  WholeImageWorkspace&, LineSet&);

}  // namespace lightstripe
