// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/border_window.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace lightstripe {
namespace {

/// Only where the line leaves the border steeply enough; else the shift would fetch far pixels.
constexpr double kLeastAcross = 0.3;

/// Grey value between the pixels of one row or column, at a place inside it.
template <class T>
T between(const T* first, std::ptrdiff_t step, int count, double place) {
  const double inside = std::clamp(place, 0.0, count - 1.0);
  const int at = std::min(static_cast<int>(inside), std::max(count - 2, 0));
  const double part = inside - at, a = first[at * step], b = first[std::min(at + 1, count - 1) * step];
  return static_cast<T>(a + part * (b - a) + 0.5);
}

/// A row of the image: copied inside, and beyond its ends taken from the border columns.
template <class T>
void fill_row(ImageView<T> image, const BorderWindow& w, int y, T* out) {
  const double slope = std::abs(w.tangent_x) > kLeastAcross ? w.tangent_y / w.tangent_x : 0.0;
  const int first = std::clamp(-w.left, 0, w.taps), last = std::clamp(image.width - w.left, first, w.taps);
  std::copy(image.row(y) + w.left + first, image.row(y) + w.left + last, out + first);
  const auto beyond = [&](int i, int column) {
    const double shifted = y + slope * (column - (w.left + i));
    return between(image.data + column, image.stride, image.height, shifted);
  };
  for (int i = 0; i < first; ++i) out[i] = beyond(i, 0);
  for (int i = last; i < w.taps; ++i) out[i] = beyond(i, image.width - 1);
}

/// A row above or below the image, from its border row.
template <class T>
void fill_row_outside(ImageView<T> image, const BorderWindow& w, int y, T* out) {
  const int border = y < 0 ? 0 : image.height - 1;
  const double slope = std::abs(w.tangent_y) > kLeastAcross ? w.tangent_x / w.tangent_y : 0.0;
  for (int i = 0; i < w.taps; ++i) {
    const int x = w.left + i;
    const double shift = x >= 0 && x < image.width ? slope * (border - y) : 0.0;
    out[i] = between(image.row(border), 1, image.width, x + shift);
  }
}

}  // namespace

template <class T>
void fill_border_window(ImageView<T> image, const BorderWindow& place, std::vector<T>& window) {
  window.assign(static_cast<std::size_t>(place.taps) * static_cast<std::size_t>(place.pitch), T{});
  for (int j = 0; j < place.taps; ++j) {
    const int y = place.top + j;
    T* out = window.data() + static_cast<std::ptrdiff_t>(j) * place.pitch;
    if (y >= 0 && y < image.height)
      fill_row(image, place, y, out);
    else
      fill_row_outside(image, place, y, out);
  }
}

template void fill_border_window<std::uint8_t>(ImageView8, const BorderWindow&, std::vector<std::uint8_t>&);
template void fill_border_window<std::uint16_t>(ImageView16, const BorderWindow&,
                                                std::vector<std::uint16_t>&);

}  // namespace lightstripe
