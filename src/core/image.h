// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Grey-value images: a view for every function that looks, an owner for those that keep.
// Pixel (0, 0) is the centre of the top-left pixel; rows run along x.
#pragma once

#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

namespace lightstripe {

/// Levels of an image's `where`.
struct LaserPlace {
  static constexpr std::uint8_t kNone = 0, kFaint = 1, kSure = 2;
  /// Surely in other light: the colour rises far less than along the rest of a line.
  static constexpr std::uint8_t kOtherLight = 3;
  /// Surely the laser, and clipped before a background was taken away.
  static constexpr std::uint8_t kClipped = 4;
};
/// Level of an image's `rise` where the laser's own channel is clipped, so that its colour tells nothing.
inline constexpr std::uint8_t kClippedRise = 255;

/// Pixels of somebody else (a cv::Mat, a line-scan camera's buffer, an array). `stride` counts elements, not
/// bytes.
template <class T>
struct ImageView {
  const T* data = nullptr;
  int width = 0;
  int height = 0;
  std::ptrdiff_t stride = 0;
  /// Where light of the laser's colour was seen, one byte a pixel with the same stride (LaserPlace); null:
  /// nobody knows, it may be anywhere.
  const std::uint8_t* where = nullptr;
  /// By how many grey levels the laser's channel rises over the other two, against its surroundings: one byte
  /// a pixel with the same stride, kClippedRise in clipped cores; null: nobody knows.
  const std::uint8_t* rise = nullptr;

  const T* row(int y) const { return data + y * stride; }
  T operator()(int x, int y) const { return row(y)[x]; }
  bool empty() const { return width <= 0 || height <= 0; }
  bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
  /// The part of `w` x `h` pixels that begins at (x, y), which has to lie inside.
  ImageView crop(int x, int y, int w, int h) const {
    const auto moved = [&](const std::uint8_t* plane) {
      return plane == nullptr ? nullptr : plane + y * stride + x;
    };
    return {row(y) + x, w, h, stride, moved(where), moved(rise)};
  }
  /// How sure the laser's colour is at a pixel; sure everywhere in a picture without colour.
  std::uint8_t laser_colour(int x, int y) const {
    return where == nullptr ? LaserPlace::kSure : where[y * stride + x];
  }
};

/// Pixels owned, without padding between the rows.
template <class T>
struct Image {
  std::vector<T> pixels;
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> where, rise;  ///< as in ImageView; empty: nobody knows

  Image() = default;
  Image(int w, int h, T value = T{})
      : pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), value), width(w), height(h) {}

  ImageView<T> view() const {
    return {pixels.data(),
            width,
            height,
            width,
            where.empty() ? nullptr : where.data(),
            rise.empty() ? nullptr : rise.data()};
  }
  operator ImageView<T>() const { return view(); }  // NOLINT(google-explicit-constructor): an owner is a view
  T* row(int y) { return pixels.data() + static_cast<std::ptrdiff_t>(y) * width; }
  const T* row(int y) const { return pixels.data() + static_cast<std::ptrdiff_t>(y) * width; }
  T& operator()(int x, int y) { return row(y)[x]; }
  T operator()(int x, int y) const { return row(y)[x]; }
  bool empty() const { return pixels.empty(); }
};

using ImageView8 = ImageView<std::uint8_t>;
using ImageView16 = ImageView<std::uint16_t>;
using Image8 = Image<std::uint8_t>;
using Image16 = Image<std::uint16_t>;

/// A picture with the bits that it was recorded with.
using GreyImage = std::variant<Image8, Image16>;

}  // namespace lightstripe
