// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/raw_frames.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include "io/live_source.h"
#include "tests/io/temp_folder.h"

namespace lightstripe {
namespace {

using testing::HasSubstr;

/// `frames` frames of 4 x 3 pixels; pixel k of frame i is 20 i + k.
std::string frames_of_bytes(int frames) {
  std::string bytes;
  for (int i = 0; i < frames; ++i)
    for (int k = 0; k < 12; ++k) bytes.push_back(static_cast<char>(20 * i + k));
  return bytes;
}

TEST(RawFrames, LieInOneFileOneBehindTheOther) {
  const TempFolder folder;
  folder.write("scan.raw", "headers" + frames_of_bytes(3));
  const auto frames =
      open_frames(folder.path(), "raw:scan.raw?width=4&height=3&bits=8&skip=7", Channel::kAuto);
  ASSERT_EQ(frames->size(), 3);
  EXPECT_EQ(frames->name(2), "scan.raw#2");
  EXPECT_EQ(frames->file(2), folder / "scan.raw");
  EXPECT_EQ(frames->channel(), Channel::kGray);
  const auto image = std::get<Image8>(frames->read(2));
  EXPECT_EQ(image.width, 4);
  EXPECT_EQ(image.height, 3);
  EXPECT_EQ(image(1, 2), 40 + 2 * 4 + 1);
  // Nothing is copied, and the file stays as long as the picture.
  const Picture picture = open_frames(folder.path(), "raw:scan.raw?width=4&height=3&skip=7", {})->look(1);
  EXPECT_TRUE(picture.is_mapped());
  EXPECT_EQ(std::get<Image8>(picture.image())(0, 1), 20 + 4);
}

TEST(RawFrames, LieInOneFileEach) {
  const TempFolder folder;
  for (int i : {2, 10, 1}) folder.write("f_" + std::to_string(i) + ".bin", frames_of_bytes(1));
  const auto frames = open_frames(folder.path(), "raw:f_*.bin?width=4&height=3", Channel::kAuto);
  ASSERT_EQ(frames->size(), 3);
  EXPECT_EQ(frames->name(2), "f_10.bin");
  EXPECT_EQ(frames->number(2), 10);
}

TEST(RawFrames, SixteenBitsHaveTheLowByteFirst) {
  const TempFolder folder;
  folder.write("scan.raw", std::string("\x01\x02\xff\x0f", 4));
  const auto image =
      std::get<Image16>(open_frames(folder.path(), "raw:scan.raw?width=2&height=1&bits=16", {})->read(0));
  EXPECT_EQ(image(0, 0), 0x0201);
  EXPECT_EQ(image(1, 0), 0x0fff);
}

TEST(RawFrames, WhatIsLeftOfAFrameIsTold) {
  const TempFolder folder;
  folder.write("a.raw", frames_of_bytes(2) + "rest");
  folder.write("b.raw", "");
  const auto frames = open_frames(folder.path(), "raw:*.raw?width=4&height=3", Channel::kAuto);
  ASSERT_EQ(frames->size(), 4);
  EXPECT_EQ(std::get<Image8>(frames->read(1))(0, 0), 20);
  EXPECT_THAT(error_of([&] { frames->look(2); }), HasSubstr("a.raw#2: has 4 bytes, a frame of 4 x 3 has 12"));
  EXPECT_THAT(error_of([&] { frames->read(3); }), HasSubstr("b.raw: is empty or cannot be read"));
}

TEST(RawFrames, APipeIsRefused) {
  const TempFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe.raw").c_str(), 0600), 0);
  EXPECT_THAT(error_of([&] { open_frames(folder.path(), "raw:pipe.raw?width=4&height=3", {}); }),
              HasSubstr("pipe.raw"));
}

TEST(RawFrames, OptionsAreChecked) {
  const TempFolder folder;
  folder.write("a.raw", frames_of_bytes(1));
  const auto error = [&](const std::string& options) {
    return error_of([&] { open_frames(folder.path(), "raw:a.raw" + options, Channel::kAuto); });
  };
  EXPECT_THAT(error(""), HasSubstr("does not say the width"));
  EXPECT_THAT(error("?width=4"), HasSubstr("does not say the height"));
  EXPECT_THAT(error("?width=4&height=2.5"), HasSubstr("option height of raw:a.raw: is 2.5"));
  EXPECT_THAT(error("?width=0&height=3"), HasSubstr("a whole number from 1"));
  EXPECT_THAT(error("?width=4&height=3&bits=12"), HasSubstr("option bits of raw:a.raw: is 12"));
  EXPECT_THAT(error("?width=4&height=3&depth=8"), HasSubstr("is not known"));
  EXPECT_THAT(error_of([&] { open_frames(folder.path(), "raw:b.raw?width=4&height=3", Channel::kAuto); }),
              HasSubstr("no such file"));
  EXPECT_THAT(
      error_of([&] { open_frames(folder.path(), "raw:a.raw?width=4&height=3", Channel::kRedExcess); }),
      HasSubstr("is grey and has no colour excess"));
}

TEST(RawFrames, PlayLikeACamera) {
  const TempFolder folder;
  folder.write("a.raw", frames_of_bytes(2));
  const auto source =
      open_live("raw:" + (folder / "a.raw").string() + "?width=4&height=3&frame_rate=1000", {});
  int seen = 0;
  while (const auto frame = source->next({})) EXPECT_EQ(std::get<Image8>(frame->image)(0, 0), 20 * seen++);
  EXPECT_EQ(seen, 2);
}

TEST(RawFrames, TheirFilesAreTold) {
  EXPECT_EQ(files_of_frames("raw:scan/*.raw?width=4&height=3"), "scan/*.raw");
  EXPECT_EQ(files_of_frames("scan/f_?.png"), "scan/f_?.png");
}

}  // namespace
}  // namespace lightstripe
