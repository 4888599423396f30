// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/board_overlay.h"

#include <gtest/gtest.h>

#include "io/images.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

SeenPicture seen(const fs::path& board, std::uint8_t grey) {
  write_image(board, Image8(8, 8, grey));
  SeenPicture picture;
  picture.sensor = "webcam";
  picture.board = board;
  picture.image = board.filename().string();
  return picture;
}

TEST(BoardOverlay, KeepsPicturesOfOneNameApart) {
  // The boards of the camera and those of the travel are often counted from 0 alike.
  const fs::path folder = fs::path(::testing::TempDir()) / "board_overlay_test", out = folder / "overlay";
  fs::create_directories(folder / "board");
  fs::create_directories(folder / "travel");
  write_overlays(out, {seen(folder / "board/000.png", 10), seen(folder / "travel/000.png", 200)});
  EXPECT_EQ(read_image(out / "webcam/000.png", Channel::kGray)(0, 0), 10);
  EXPECT_EQ(read_image(out / "webcam/travel_000.png", Channel::kGray)(0, 0), 200);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace lightstripe
