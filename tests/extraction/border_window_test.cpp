// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/kernels/border_window.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

namespace lightstripe {
namespace {

constexpr int kTaps = 9, kPitch = 16;

template <class F>
Image8 image_of(int width, int height, const F& grey) {
  Image8 image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image(x, y) = static_cast<std::uint8_t>(grey(x, y));
  return image;
}

/// Rows and columns [from, to) of a window at (left, top) against `grey` of the place in the image.
template <class F>
void expect_window(const Image8& image, const BorderWindow& place, int from, int to, const F& grey) {
  std::vector<std::uint8_t> window;
  fill_border_window(image.view(), place, window);
  for (int j = from; j < to; ++j)
    for (int i = from; i < to; ++i)
      EXPECT_EQ(window[static_cast<std::size_t>(j * kPitch + i)], grey(place.left + i, place.top + j))
          << i << ", " << j;
}

TEST(BorderWindow, BorderPixelsAreRepeatedWithoutATangent) {
  const Image8 image = image_of(20, 17, [](int x, int y) { return 11 * x + 3 * y; });
  const auto repeated = [&](int x, int y) { return image(std::clamp(x, 0, 19), std::clamp(y, 0, 16)); };
  for (const int left : {-8, -3, 0, 5, 13, 18})
    for (const int top : {-8, -1, 4, 10, 15})
      expect_window(image, {left, top, kTaps, kPitch, 0, 0}, 0, kTaps, repeated);
}

// Grey values that do not change along (2, 1) continue beyond the left and the right border; at half pixels
// they are linear, so that no rounding is left.
TEST(BorderWindow, ALineGoesOnBeyondTheSides) {
  const auto grey = [](int x, int y) { return 100 + 4 * (2 * y - x); };
  const Image8 image = image_of(24, 19, grey);
  expect_window(image, {-4, 5, kTaps, kPitch, 2, 1}, 0, kTaps, grey);
  expect_window(image, {19, 6, kTaps, kPitch, 2, 1}, 0, kTaps, grey);
}

TEST(BorderWindow, ALineGoesOnBeyondTopAndBottom) {
  const auto grey = [](int x, int y) { return 100 + 4 * (2 * x - y); };
  const Image8 image = image_of(19, 24, grey);
  expect_window(image, {5, -4, kTaps, kPitch, 1, 2}, 0, kTaps, grey);
  expect_window(image, {6, 19, kTaps, kPitch, 1, 2}, 0, kTaps, grey);
}

TEST(BorderWindow, AFlatLineAtTheTopIsRepeated) {
  const Image8 image = image_of(30, 12, [](int x, int) { return 8 * x; });
  expect_window(image, {10, -5, kTaps, kPitch, 1, 0.2}, 0, kTaps, [](int x, int) { return 8 * x; });
}

}  // namespace
}  // namespace lightstripe
