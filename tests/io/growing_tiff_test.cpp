// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/growing_tiff.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "io/images.h"
#include "temp_folder.h"

namespace lightstripe {
namespace {

Image8 picture(int k) {
  Image8 image(33, 20);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = static_cast<std::uint8_t>(7 * i + static_cast<std::size_t>(k));
  return image;
}

TEST(GrowingTiff, PagesAreReadWhileTheFileGrows) {
  const TempFolder folder;
  GrowingTiff file(folder / "a.tif");
  file.append(picture(0));
  for (int k = 1; k < 4; ++k) {
    file.append(picture(k));
    const auto source = open_frames(folder.path(), "a.tif", Channel::kGray);
    ASSERT_EQ(source->size(), k + 1);
    for (int i = 0; i <= k; ++i) {
      EXPECT_EQ(std::get<Image8>(source->read(i)).pixels, picture(i).pixels);  // decoded by libtiff
      EXPECT_EQ(std::get<Image8>(source->look(i).image()).pixels, picture(i).pixels);
    }
  }
}

TEST(GrowingTiff, WideNumbersAreKept) {
  const TempFolder folder;
  Image16 wide(17, 9);
  for (std::size_t i = 0; i < wide.pixels.size(); ++i) wide.pixels[i] = static_cast<std::uint16_t>(401 * i);
  GrowingTiff file(folder / "a.tif");
  file.append(wide);
  file.append(wide);
  const auto source = open_frames(folder.path(), "a.tif", Channel::kGray);
  EXPECT_EQ(std::get<Image16>(source->read(1)).pixels, wide.pixels);
}

TEST(GrowingTiff, WhatAKilledRecorderLeftBehindTheLastPageDoesNoHarm) {
  const TempFolder folder;
  {
    GrowingTiff file(folder / "a.tif");
    for (int k = 0; k < 3; ++k) file.append(picture(k));
  }
  std::ofstream(folder / "a.tif", std::ios::binary | std::ios::app) << std::string(500, 'x');
  EXPECT_EQ(open_frames(folder.path(), "a.tif", Channel::kGray)->size(), 3);
  EXPECT_THAT(error_of([&] { GrowingTiff again(folder / "a.tif"); }), testing::HasSubstr("is there already"));
}

}  // namespace
}  // namespace lightstripe
