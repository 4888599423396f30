// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <thread>

#include "io/images.h"
#include "tests/io/temp_folder.h"

namespace lightstripe {
namespace {

using testing::HasSubstr;

Image8 flat(int width, int height, int value) { return {width, height, static_cast<std::uint8_t>(value)}; }

TEST(ImageFolder, GivesFramesInNaturalOrder) {
  const TempFolder folder;
  for (int i = 0; i < 12; ++i) write_image(folder / ("f_" + std::to_string(i) + ".png"), flat(8, 6, 10 * i));
  const auto frames = open_frames(folder.path(), "f_*.png", Channel::kAuto);
  ASSERT_EQ(frames->size(), 12);
  for (int i = 0; i < 12; ++i) EXPECT_EQ(frames->read(i)(0, 0), 10 * i);
  EXPECT_EQ(frames->name(10), "f_10.png");
  EXPECT_THROW(frames->read(12), std::logic_error);
  EXPECT_EQ(open_frames(folder.path(), "f_3.png", Channel::kGray)->size(), 1);
}

TEST(ImageFolder, AFrameOfAnotherSizeIsAnError) {
  const TempFolder folder;
  write_image(folder / "1.png", flat(8, 6, 1));
  write_image(folder / "2.png", flat(6, 8, 2));
  const auto frames = open_frames(folder.path(), "*.png", Channel::kAuto);
  EXPECT_NO_THROW(frames->read(0));
  EXPECT_THAT(
      error_of([&] { frames->read(1); }),
      HasSubstr("2.png: has 6 x 8 pixels, but the first frame 1.png has 8 x 6; keep frames of one camera"));
}

TEST(ImageFolder, TheChannelIsDecidedOnceAlsoWhereTheLineComesLate) {
  const TempFolder folder;
  for (int i = 0; i < 8; ++i) {
    std::vector<std::uint8_t> rgb(40 * 30 * 3, 60);
    if (i >= 5)
      for (std::size_t x = 0; x < 40; ++x) rgb[(15 * 40 + x) * 3] = 250;
    write_rgb_image(folder / (std::to_string(i) + ".png"), rgb, 40, 30);
  }
  const auto frames = open_frames(folder.path(), "*.png", Channel::kAuto);
  EXPECT_EQ(frames->read(0)(5, 15), 0);  // red excess, also in a frame without the line
  EXPECT_EQ(frames->read(7)(5, 15), 190);
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
  for (const int i : {0, 1, 2, 10, 5, 99, 98, 3, 0, 50}) EXPECT_EQ(bar_of(frames->read(i)), i);
}

TEST(VideoFrames, MayBeReadFromSeveralThreads) {
  const TempFolder folder;
  if (!write_video(folder / "a.avi")) GTEST_SKIP() << "OpenCV cannot write a video here";
  const auto frames = open_frames(folder.path(), "a.avi", Channel::kGray);
  std::vector<int> bars(kFrames, -1);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&frames, &bars, t] {
      for (int i = t; i < kFrames; i += 4) bars[static_cast<std::size_t>(i)] = bar_of(frames->read(i));
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
