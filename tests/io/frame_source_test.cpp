// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <thread>

#include "io/images.h"
#include "tests/io/temp_folder.h"

namespace lightstripe {
namespace {

using testing::HasSubstr;

const Image8& grey8(const GreyImage& image) { return std::get<Image8>(image); }

Image8 flat(int width, int height, int value) { return {width, height, static_cast<std::uint8_t>(value)}; }

TEST(ImageFolder, GivesFramesInNaturalOrder) {
  const TempFolder folder;
  for (int i = 0; i < 12; ++i) write_image(folder / ("f_" + std::to_string(i) + ".png"), flat(8, 6, 10 * i));
  const auto frames = open_frames(folder.path(), "f_*.png", Channel::kAuto);
  ASSERT_EQ(frames->size(), 12);
  for (int i = 0; i < 12; ++i) EXPECT_EQ(grey8(frames->read(i))(0, 0), 10 * i);
  EXPECT_EQ(frames->name(10), "f_10.png");
  EXPECT_THROW(frames->read(12), std::logic_error);
  EXPECT_EQ(open_frames(folder.path(), "f_3.png", Channel::kGray)->size(), 1);
}

TEST(ImageFolder, OpensAlsoWhereTheFirstPictureIsDamaged) {
  const TempFolder folder;
  folder.write("1.png", "");
  write_image(folder / "2.png", flat(6, 8, 2));
  const auto frames = open_frames(folder.path(), "*.png", Channel::kAuto);
  EXPECT_THAT(error_of([&] { frames->read(0); }), HasSubstr("1.png: is empty"));
  EXPECT_EQ(grey8(frames->read(1)).height, 8);
}

TEST(ImageFolder, SixteenBitsAreKept) {
  const TempFolder folder;
  cv::Mat wide(6, 8, CV_16U, cv::Scalar(1000));
  wide.at<std::uint16_t>(2, 3) = 4000;
  for (const std::string name : {"1.png", "1.tif", "1.pgm"}) {
    ASSERT_TRUE(cv::imwrite((folder / name).string(), wide));
    const auto frames = open_frames(folder.path(), name, Channel::kAuto);
    const auto image = std::get<Image16>(frames->read(0));
    EXPECT_EQ(image(3, 2), 4000) << name;
    EXPECT_EQ(image(0, 0), 1000) << name;
  }
  // In 8 bits white is that of the 12 bits that hold the picture.
  EXPECT_EQ(read_image(folder / "1.png")(3, 2), 249);
}

TEST(ImageFolder, TheChannelIsDecidedOnceAlsoWhereTheLineComesLate) {
  const TempFolder folder;
  for (int i = 0; i < 8; ++i) {
    std::vector<std::uint8_t> rgb(40 * 30 * 3, 60);
    for (std::size_t p = 0; p < 40 * 30; ++p) rgb[3 * p + 2] = 20;
    if (i >= 5)
      for (std::size_t x = 0; x < 40; ++x) rgb[(15 * 40 + x) * 3] = 250;
    write_rgb_image(folder / (std::to_string(i) + ".png"), rgb, 40, 30);
  }
  const auto frames = open_frames(folder.path(), "*.png", Channel::kAuto);
  // Half of red and a quarter of the others (a clipped red line), also in a frame without the line; grey
  // would be 55 and 112.
  EXPECT_EQ(grey8(frames->read(0))(5, 15), 50);
  EXPECT_EQ(grey8(frames->read(7))(5, 15), 145);
}

TEST(TiffPages, AreTheFramesWhateverTheirCompression) {
  const TempFolder folder;
  for (const int compression : {1, 5, 8}) {  // none, LZW, deflate
    std::vector<cv::Mat> pages;
    for (int i = 0; i < 7; ++i)
      pages.emplace_back(30, 40 + i, i % 2 == 0 ? CV_8U : CV_16U, cv::Scalar(10 * i));
    ASSERT_TRUE(cv::imwrite((folder / "a.tif").string(), pages, {cv::IMWRITE_TIFF_COMPRESSION, compression}));
    const auto frames = open_frames(folder.path(), "a.tif", Channel::kGray);
    ASSERT_EQ(frames->size(), 7);
    EXPECT_EQ(frames->name(3), "a.tif#3");
    for (const int i : {0, 6, 2, 4}) {
      const Image8 page = grey8(frames->read(i));
      EXPECT_EQ(page.width, 40 + i);
      EXPECT_EQ(page(39, 29), 10 * i);
    }
    EXPECT_EQ(std::get<Image16>(frames->read(5))(39, 29), 50);
  }
}

TEST(TiffPages, OfATruncatedFileThoseBeforeItsEndAreReadAndTheLossIsNamed) {
  const TempFolder folder;
  const std::vector<cv::Mat> pages(6, cv::Mat(50, 60, CV_8U, cv::Scalar(7)));
  ASSERT_TRUE(cv::imwrite((folder / "a.tif").string(), pages, {cv::IMWRITE_TIFF_COMPRESSION, 1}));
  const std::string whole = content_of(folder / "a.tif");
  int readable = 0;
  for (std::size_t length = 8; length < whole.size(); length += 997) {
    folder.write("b.tif", whole.substr(0, length));
    try {
      const auto frames = open_frames(folder.path(), "b.tif", Channel::kGray);
      for (std::int64_t i = 0; i < frames->size(); ++i) {
        try {
          EXPECT_EQ(grey8(frames->read(i)).pixels, std::vector<std::uint8_t>(3000, 7));
          ++readable;
        } catch (const Error& error) {
          EXPECT_THAT(error.what(), HasSubstr("b.tif"));
        }
      }
    } catch (const Error&) {
      continue;  // not even one whole page
    }
  }
  EXPECT_GT(readable, 10);
}

TEST(TiffPages, AChainThatBitesItsTailEnds) {
  const TempFolder folder;
  // Two directories without entries worth the name, the second pointing back to the first.
  std::string bytes("II*\0\x08\0\0\0", 8);
  bytes += std::string("\x01\0\0\1\3\0\1\0\0\0\5\0\0\0\x1a\0\0\0", 18);
  bytes += std::string("\x01\0\0\1\3\0\1\0\0\0\5\0\0\0\x08\0\0\0", 18);
  folder.write("a.tif", bytes);
  const auto frames = open_frames(folder.path(), "a.tif", Channel::kGray);
  EXPECT_LE(frames->size(), 4);
  EXPECT_THAT(error_of([&] { frames->read(0); }), HasSubstr("a.tif#0"));
}

constexpr int kFrames = 100;
constexpr int kBar = 4;  // px; frame i is bright in the columns before kBar * i

/// A bar that grows frame by frame; false where no encoder is at hand.
bool write_video(const std::filesystem::path& path) {
  cv::VideoWriter writer(path.string(), cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 25,
                         {kBar * kFrames, 64});
  for (int i = 0; writer.isOpened() && i < kFrames; ++i) {
    cv::Mat frame(64, kBar * kFrames, CV_8UC3, cv::Scalar::all(20));
    cv::rectangle(frame, {0, 0, kBar * i, 64}, cv::Scalar::all(220), cv::FILLED);
    writer.write(frame);
  }
  return writer.isOpened();
}

int bar_of(const Image8& image) {
  int bright = 0;
  while (bright < image.width && image(bright, 32) > 120) ++bright;
  return (bright + kBar / 2) / kBar;
}

TEST(VideoFrames, AreTheRecordedOnesInAnyOrder) {
  const TempFolder folder;
  if (!write_video(folder / "a.avi")) GTEST_SKIP() << "OpenCV cannot write a video here";
  const auto frames = open_frames(folder.path(), "a.avi", Channel::kAuto);
  ASSERT_EQ(frames->size(), kFrames);
  EXPECT_EQ(frames->name(12), "a.avi#12");
  for (const int i : {0, 1, 2, 10, 5, 99, 98, 3, 0, 50}) EXPECT_EQ(bar_of(grey8(frames->read(i))), i);
}

TEST(VideoFrames, MayBeReadFromSeveralThreads) {
  const TempFolder folder;
  if (!write_video(folder / "a.avi")) GTEST_SKIP() << "OpenCV cannot write a video here";
  const auto frames = open_frames(folder.path(), "a.avi", Channel::kGray);
  std::vector<int> bars(kFrames, -1);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&frames, &bars, t] {
      for (int i = t; i < kFrames; i += 4) bars[static_cast<std::size_t>(i)] = bar_of(grey8(frames->read(i)));
    });
  for (std::thread& thread : threads) thread.join();
  for (int i = 0; i < kFrames; ++i) EXPECT_EQ(bars[static_cast<std::size_t>(i)], i);
}

TEST(VideoFrames, WhatIsNoVideoIsAnError) {
  const TempFolder folder;
  folder.write("a.avi", "not a video");
  EXPECT_THAT(error_of([&] { open_frames(folder.path(), "a.avi", Channel::kAuto); }),
              HasSubstr("a.avi: cannot be opened as a video"));
}

}  // namespace
}  // namespace lightstripe
