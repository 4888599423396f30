// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/compare/hu_recursive.h"

#include <algorithm>
#include <array>

#include "extraction/kernels/recursive_gaussian.h"

namespace lightstripe {
namespace {

/// The image on its side, so that filters along columns run along its rows.
template <class T>
void transpose_pixels(ImageView<T> image, Image<float>& out) {
  constexpr int kBlock = 32;
  out.width = image.height;
  out.height = image.width;
  out.pixels.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  for (int y0 = 0; y0 < image.height; y0 += kBlock)
    for (int x = 0; x < image.width; ++x)
      for (int y = y0; y < std::min(y0 + kBlock, image.height); ++y)
        out(y, x) = static_cast<float>(image(x, y));
}

}  // namespace

template <class T>
void find_lines_hu(ImageView<T> image, const DerivativeKernels& kernels, const RidgeLimits& limits,
                   WholeImageWorkspace& w, LineSet& lines) {
  const std::array<RecursiveFilter, 3> filters{make_recursive_filter(kernels.sigma, 0),
                                               make_recursive_filter(kernels.sigma, 1),
                                               make_recursive_filter(kernels.sigma, 2)};
  transpose_pixels(image, w.input);
  const auto along_rows = [&](std::size_t order) {
    filter_columns(w.input, filters[order], w.filtered);
    transpose(w.filtered, w.transposed);
  };
  along_rows(0);
  filter_columns(w.transposed, filters[1], w.planes.dy);
  filter_columns(w.transposed, filters[2], w.planes.dyy);
  along_rows(1);
  filter_columns(w.transposed, filters[0], w.planes.dx);
  filter_columns(w.transposed, filters[1], w.planes.dxy);
  along_rows(2);
  filter_columns(w.transposed, filters[0], w.planes.dxx);
  find_lines_in_planes(image, kernels, limits, w, lines);
}

template void find_lines_hu<std::uint8_t>(ImageView8, const DerivativeKernels&, const RidgeLimits&,
                                          WholeImageWorkspace&, LineSet&);
template void find_lines_hu<std::uint16_t>(ImageView16, const DerivativeKernels&, const RidgeLimits&,
                                           WholeImageWorkspace&, LineSet&);

}  // namespace lightstripe
