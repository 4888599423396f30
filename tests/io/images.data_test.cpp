// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Real pictures beside the project's folder; left out where they are not there.
#include <gtest/gtest.h>

#include "io/images.h"
#include "test_paths.h"

namespace lightstripe {
namespace {

const std::filesystem::path kData = std::filesystem::path(LIGHTSTRIPE_SOURCE_DIR) / "../shared/data";

Channel chosen_for(const std::string& name) {
  Channel chosen = Channel::kAuto;
  read_image(kData / name, Channel::kAuto, &chosen);
  return chosen;
}

TEST(ChannelAuto, TakesRedOfEveryRealRedLine) {
  if (!std::filesystem::exists(kData / "pot")) GTEST_SKIP() << "no ../shared/data/pot";
  for (const char* pattern : {"pot/board/*.png", "pot/scan/*.png"})
    for (const auto& file : list_files(kData, pattern))
      EXPECT_TRUE(enum_name(chosen_for(std::filesystem::relative(file, kData).string())).starts_with("red-"))
          << file;
}

TEST(ChannelAuto, AddsTheOtherChannelsWhereTheRealLineIsOverexposed) {
  // The core of the hub's line is (255, 156, 255) and the like: nothing is left of it in the red excess.
  if (!std::filesystem::exists(kData / "stripes")) GTEST_SKIP() << "no ../shared/data/stripes";
  for (const auto& file : list_files(kData, "stripes/hub_*.png"))
    EXPECT_EQ(enum_name(chosen_for(std::filesystem::relative(file, kData).string())), "red-clipped") << file;
}

TEST(FrameSource, OpensARealScan) {
  if (!std::filesystem::exists(kData / "pot")) GTEST_SKIP() << "no ../shared/data/pot";
  const auto frames = open_frames(kData, "pot/scan/*.png", Channel::kAuto);
  ASSERT_EQ(frames->size(), 36);
  EXPECT_EQ(frames->name(35), "035.png");
  const auto image = std::get<Image8>(frames->read(35));
  EXPECT_EQ(image.width, 1152);
  EXPECT_EQ(image.height, 768);
}

}  // namespace
}  // namespace lightstripe
