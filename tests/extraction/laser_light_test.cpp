// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/image/background.h"

#include <gtest/gtest.h>

#include "core/random.h"

namespace lightstripe {
namespace {

/// Squares of 20 and 180 grey levels, the laser picture darker by `gain` and offset, a bright line in
/// column 50.
struct Pair {
  Image8 board{100, 80}, laser{100, 80};
  Pair(double gain, double offset) {
    Random random(3);
    for (int y = 0; y < 80; ++y) {
      for (int x = 0; x < 100; ++x) {
        const double level = ((x / 10 + y / 10) % 2 == 0 ? 20 : 180) + 2 * random.gaussian();
        const double line = x == 50 ? 60 : 0;
        board(x, y) = static_cast<std::uint8_t>(level);
        laser(x, y) = static_cast<std::uint8_t>(
            std::min(255.0, gain * level + offset + line + 1.5 * random.gaussian()));
      }
    }
  }
};

TEST(LaserLight, FindsTheAmbientChangeOfADarkerPicture) {
  const Pair pair(0.25, 7);
  const AmbientChange change = fit_ambient_change(pair.laser, pair.board);
  EXPECT_NEAR(change.gain, 0.25, 0.01);
  EXPECT_NEAR(change.offset, 7, 1);  // a median is a whole grey level
}

TEST(LaserLight, KeepsTheLineWhereTheBoardPictureIsBrighterThanTheLaser) {
  const Pair pair(0.25, 7);
  const Image8 light = laser_light(pair.laser, pair.board);
  for (int y = 0; y < 80; ++y) {
    EXPECT_NEAR(light(50, y), kDarkLevel + 60, 9)
        << y;  // 1.5 grey levels of noise, 4 sigma, and the roundings
    EXPECT_NEAR(light(20, y), kDarkLevel, 8) << y;
  }
}

TEST(LaserLight, SubtractsOneToOneWhereTheBoardPictureHasNoContrast) {
  Image8 board(60, 60, 40), laser(60, 60, 43);
  for (int y = 0; y < 60; ++y) laser(30, y) = 200;
  const AmbientChange change = fit_ambient_change(laser, board);
  EXPECT_EQ(change.gain, 1.0);
  EXPECT_EQ(change.offset, 3.0);
  EXPECT_EQ(laser_light(laser, board)(30, 10), kDarkLevel + 157);
}

TEST(LaserLight, IsNotMisledByAReflectionOnOneLevel) {
  Pair pair(1.0, 0);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 20; ++x) pair.laser(x, y) = 255;
  const AmbientChange change = fit_ambient_change(pair.laser, pair.board);
  EXPECT_NEAR(change.gain, 1.0, 0.03);
}

}  // namespace
}  // namespace lightstripe
