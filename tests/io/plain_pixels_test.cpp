// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/plain_pixels.h"

#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "temp_folder.h"

namespace lightstripe {
namespace {

cv::Mat noise(int width, int height) {
  cv::Mat picture(height, width, CV_8UC1);
  cv::RNG(7).fill(picture, cv::RNG::UNIFORM, 0, 256);
  return picture;
}

/// Pixels that are not those of read_grey_image(); -1 where the file has to be decoded.
int differing_pixels(const std::filesystem::path& path) {
  const auto mapped = map_picture(path, Channel::kGray);
  if (!mapped) return -1;
  const Image8 read = std::get<Image8>(read_grey_image(path, Channel::kGray));
  return mapped->visit([&](const auto& view) {
    if (view.width != read.width || view.height != read.height) return 1 << 30;
    int differing = 0;
    for (int y = 0; y < read.height; ++y)
      for (int x = 0; x < read.width; ++x) differing += view(x, y) != read(x, y) ? 1 : 0;
    return differing;
  });
}

TEST(PlainPixels, PgmBmpAndPlainTiffAreSeenWhereTheyLie) {
  const TempFolder folder;
  for (const int width : {64, 61}) {  // 61: BMP rows are padded
    const cv::Mat picture = noise(width, 48);
    cv::imwrite((folder / "a.pgm").string(), picture);
    cv::imwrite((folder / "a.bmp").string(), picture);
    cv::imwrite((folder / "a.tif").string(), picture, {cv::IMWRITE_TIFF_COMPRESSION, 1});
    for (const char* name : {"a.pgm", "a.bmp", "a.tif"})
      EXPECT_EQ(differing_pixels(folder / name), 0) << name << " " << width;
  }
}

TEST(PlainPixels, WhatHasToBeDecodedIsLeftToTheDecoder) {
  const TempFolder folder;
  const cv::Mat picture = noise(64, 48);
  cv::Mat wide, colour;
  picture.convertTo(wide, CV_16U, 200);
  cv::merge(std::vector<cv::Mat>{picture, picture / 2, picture / 3}, colour);
  cv::imwrite((folder / "packed.tif").string(), picture, {cv::IMWRITE_TIFF_COMPRESSION, 5});
  cv::imwrite((folder / "wide.pgm").string(), wide);
  cv::imwrite((folder / "wide.tif").string(), wide, {cv::IMWRITE_TIFF_COMPRESSION, 1});
  cv::imwrite((folder / "colour.bmp").string(), colour);
  cv::imwrite((folder / "a.png").string(), picture);
  for (const char* name : {"packed.tif", "wide.pgm", "wide.tif", "colour.bmp", "a.png", "missing.pgm"})
    EXPECT_EQ(differing_pixels(folder / name), -1) << name;
  cv::imwrite((folder / "a.pgm").string(), picture);
  EXPECT_FALSE(map_picture(folder / "a.pgm", Channel::kRedExcess));
}

TEST(PlainPixels, ACutFileIsLeftToTheDecoderWhichSaysWhy) {
  const TempFolder folder;
  const cv::Mat picture = noise(64, 48);
  for (const char* name : {"a.pgm", "a.bmp", "a.tif"}) {
    cv::imwrite((folder / name).string(), picture, {cv::IMWRITE_TIFF_COMPRESSION, 1});
    std::filesystem::resize_file(folder / name, 1500);
    EXPECT_FALSE(map_picture(folder / name, Channel::kGray)) << name;
  }
}

// Found by libFuzzer: of two alike tags the library takes the first, and the other one was looked at.
TEST(PlainPixels, ADirectoryThatNamesATagTwiceIsLeftToTheDecoder) {
  const TempFolder folder;
  const auto path = folder / "a.tif";
  cv::imwrite(path.string(), noise(64, 48), {cv::IMWRITE_TIFF_COMPRESSION, 1});
  ASSERT_EQ(differing_pixels(path), 0);
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  std::string bytes(8, '\0');
  file.read(bytes.data(), 8);
  ASSERT_EQ(bytes.substr(0, 4), std::string("II*\0", 4));
  const auto directory = static_cast<unsigned char>(bytes[4]) + 256 * static_cast<unsigned char>(bytes[5]) +
                         65536 * static_cast<unsigned char>(bytes[6]);
  // The second entry, the height, gets the first one's tag.
  file.seekg(directory + 2);
  file.read(bytes.data(), 2);
  file.seekp(directory + 2 + 12);
  file.write(bytes.data(), 2);
  file.close();
  EXPECT_FALSE(map_picture(path, Channel::kGray));
}

TEST(PlainPixels, PagesOfATiffAreSeenWhereTheyLie) {
  const TempFolder folder;
  const std::vector<cv::Mat> pages = {noise(32, 24), noise(32, 24) / 2};
  cv::imwritemulti((folder / "pages.tif").string(), pages, {cv::IMWRITE_TIFF_COMPRESSION, 1});
  const auto source = open_frames(folder.path(), "pages.tif", Channel::kGray);
  ASSERT_EQ(source->size(), 2);
  for (std::int64_t i = 0; i < 2; ++i) {
    const Picture picture = source->look(i);
    EXPECT_TRUE(picture.is_mapped());
    EXPECT_EQ(std::get<Image8>(picture.image()).pixels, std::get<Image8>(source->read(i)).pixels);
  }
}

}  // namespace
}  // namespace lightstripe
