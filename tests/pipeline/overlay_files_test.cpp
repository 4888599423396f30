// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/overlay_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lightstripe {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;

TEST(OverlayFiles, KeepPicturesOfOneNameApart) {
  EXPECT_THAT(overlay_files({"a/1.png", "a/2.tif", "b/1.png", "c/b/1.png", "b/1.bmp"}, "out"),
              ElementsAre(fs::path("out/1.png"), fs::path("out/2.png"), fs::path("out/b_1.png"),
                          fs::path("out/1_2.png"), fs::path("out/1_3.png")));
}

TEST(OverlayFiles, OfBoardsLieInTheFolderOfTheirSensor) {
  EXPECT_THAT(board_overlay_files(
                  {{"left", "board/1.png"}, {"right", "board/1.png"}, {"left", "travel/1.png"}}, "out"),
              ElementsAre(fs::path("out/left/1.png"), fs::path("out/right/1.png"),
                          fs::path("out/left/travel_1.png")));
}

}  // namespace
}  // namespace lightstripe
