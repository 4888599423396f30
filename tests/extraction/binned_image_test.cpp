// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/image/binned_image.h"

#include <gtest/gtest.h>

namespace lightstripe {
namespace {

TEST(BinnedImage, MeansOfWholeBlocks) {
  Image8 image(7, 5);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 7; ++x) image(x, y) = static_cast<std::uint8_t>(10 * y + x);
  Image8 binned;
  bin_image(image.view(), 2, binned);
  ASSERT_EQ(binned.width, 3);
  ASSERT_EQ(binned.height, 2);
  // Block (2, 1): columns 4, 5 of rows 2, 3: 24 25 34 35.
  EXPECT_NEAR(binned(2, 1), 29.5, 0.51);
  EXPECT_NEAR(binned(0, 0), 5.5, 0.51);
}

TEST(BinnedImage, SixteenBitsStayWithinTheirRange) {
  const Image16 image(6, 6, 65535);
  Image16 binned;
  bin_image(image.view(), 3, binned);
  EXPECT_EQ(binned(1, 1), 65535);
}

}  // namespace
}  // namespace lightstripe
