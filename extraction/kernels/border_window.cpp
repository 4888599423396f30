// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/kernels/border_window.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace lightstripe {
namespace {

/// Only where the line leaves the border steeply enough; else the shift would fetch far pixels.
constexpr double kLeastAcross = 0.3;

/// One row or column of the border, read at places shifted by a constant that need not be whole.
template <class T>
struct ShiftedLine {
  const T* first;
  std::ptrdiff_t step;
  int count;
  int whole;   ///< floor of the shift
  float part;  ///< the rest

  ShiftedLine(const T* line, std::ptrdiff_t line_step, int line_count, double shift)
      : first(line), step(line_step), count(line_count) {
    const double bounded = std::clamp(shift, -1.0 * line_count, 1.0 * line_count);
    whole = static_cast<int>(std::floor(bounded));
    part = static_cast<float>(bounded - whole);
  }
  /// Whether the places first ... last need no clamping.
  bool contains(int begin, int end) const { return begin + whole >= 0 && end + whole + 1 < count; }
  static T between(float a, float b, float part) {
    return static_cast<T>(static_cast<int>(a + part * (b - a) + 0.5F));
  }
  T operator()(int place) const {
    const int at = place + whole;
    const double a = first[std::clamp(at, 0, count - 1) * step],
                 b = first[std::clamp(at + 1, 0, count - 1) * step];
    return static_cast<T>(a + part * (b - a) + 0.5);
  }
};

/// The window's columns left and right of the image, where its rows lie inside.
template <class T>
void fill_columns_outside(ImageView<T> image, const BorderWindow& w, std::vector<T>& window) {
  const double slope = std::abs(w.tangent_x) > kLeastAcross ? w.tangent_y / w.tangent_x : 0.0;
  const int first = std::max(0, -w.top), last = std::min(w.taps, image.height - w.top);
  for (int i = 0; i < w.taps; ++i) {
    const int x = w.left + i;
    if (x >= 0 && x < image.width) continue;
    const int column = x < 0 ? 0 : image.width - 1;
    const ShiftedLine<T> line(image.data + column, image.stride, image.height, slope * (column - x));
    T* out = window.data() + first * w.pitch + i;
    if (slope == 0) {
      const T* pixel = line.first + (w.top + first) * line.step;
      for (int j = first; j < last; ++j, out += w.pitch, pixel += line.step) *out = *pixel;
      continue;
    }
    if (!line.contains(w.top + first, w.top + last)) {
      for (int j = first; j < last; ++j, out += w.pitch) *out = line(w.top + j);
      continue;
    }
    const T* pixel = line.first + (w.top + first + line.whole) * line.step;
    float previous = *pixel;
    for (int j = first; j < last; ++j, out += w.pitch) {
      pixel += line.step;
      const float next = *pixel;
      *out = ShiftedLine<T>::between(previous, next, line.part);
      previous = next;
    }
  }
}

/// A few pixels; a call would cost more than they do. The two regions do not overlap.
template <class T>
void copy_few(const T* from, int count, T* to) {
  constexpr int kChunk = 8 / sizeof(T);
  if (count < kChunk) {
    for (int i = 0; i < count; ++i) to[i] = from[i];
    return;
  }
  // The last chunk overlaps the one before.
  for (int i = 0; i + kChunk < count; i += kChunk) std::memcpy(to + i, from + i, 8);
  std::memcpy(to + count - kChunk, from + count - kChunk, 8);
}

/// A row above or below the image, from its border row; the corners are repeated. Columns [first, last) of
/// the window lie inside the image.
template <class T>
void fill_row_outside(ImageView<T> image, const BorderWindow& w, int y, int first, int last, T* out) {
  const T* border = image.row(y < 0 ? 0 : image.height - 1);
  const double slope = std::abs(w.tangent_y) > kLeastAcross ? w.tangent_x / w.tangent_y : 0.0;
  const ShiftedLine<T> line(border, 1, image.width, slope * (y < 0 ? -y : image.height - 1 - y));
  for (int i = 0; i < first; ++i) out[i] = border[0];
  for (int i = last; i < w.taps; ++i) out[i] = border[image.width - 1];
  if (slope == 0) return copy_few(border + w.left + first, last - first, out + first);
  if (!line.contains(w.left + first, w.left + last)) {
    for (int i = first; i < last; ++i) out[i] = line(w.left + i);
    return;
  }
  const T* pixel = border + w.left + line.whole;
  for (int i = first; i < last; ++i) out[i] = ShiftedLine<T>::between(pixel[i], pixel[i + 1], line.part);
}

/// The whole window where no direction is known: each row is the nearest one of the image, its ends repeated.
template <class T>
void repeat_border(ImageView<T> image, const BorderWindow& w, int first, int last, std::vector<T>& window) {
  T* out = window.data();
  for (int j = 0; j < w.taps; ++j, out += w.pitch) {
    const T* row = image.row(std::clamp(w.top + j, 0, image.height - 1));
    for (int i = 0; i < first; ++i) out[i] = row[0];
    copy_few(row + w.left + first, last - first, out + first);
    for (int i = last; i < w.taps; ++i) out[i] = row[image.width - 1];
  }
}

}  // namespace

template <class T>
void fill_border_window(ImageView<T> image, const BorderWindow& place, std::vector<T>& window) {
  // What is left from before in columns that have no weight is only multiplied by 0.
  window.resize(static_cast<std::size_t>(place.taps) * static_cast<std::size_t>(place.pitch));
  const int first = std::clamp(-place.left, 0, place.taps);
  const int last = std::clamp(image.width - place.left, first, place.taps);
  if (place.tangent_x == 0 && place.tangent_y == 0) return repeat_border(image, place, first, last, window);
  for (int j = 0; j < place.taps; ++j) {
    const int y = place.top + j;
    T* out = window.data() + static_cast<std::ptrdiff_t>(j) * place.pitch;
    if (y >= 0 && y < image.height)
      copy_few(image.row(y) + place.left + first, last - first, out + first);
    else
      fill_row_outside(image, place, y, first, last, out);
  }
  fill_columns_outside(image, place, window);
}

template void fill_border_window<std::uint8_t>(ImageView8, const BorderWindow&, std::vector<std::uint8_t>&);
template void fill_border_window<std::uint16_t>(ImageView16, const BorderWindow&,
                                                std::vector<std::uint16_t>&);

}  // namespace lightstripe
