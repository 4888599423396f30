// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/laser_colour.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <tuple>

#include "core/image.h"
#include "io/choose_channel.h"

namespace lightstripe {
namespace {

/// 320 x 240, room light of these levels, with a vertical stripe at x = 160: `laser` times a Gaussian of 3
/// px is added to the planes B, G, R, each clipped at 255.
ColourPlanes room_with_line(const std::array<double, 3>& laser,
                            const std::array<double, 3>& room = {60, 60, 60}) {
  ColourPlanes planes;
  for (std::size_t k = 0; k < 3; ++k) {
    planes.at(k) = cv::Mat(240, 320, CV_8UC1);
    for (int y = 0; y < 240; ++y)
      for (int x = 0; x < 320; ++x) {
        const double line = std::exp(-0.5 * (x - 160) * (x - 160) / 9.0);
        planes.at(k).at<std::uint8_t>(y, x) =
            static_cast<std::uint8_t>(std::clamp(room.at(k) + laser.at(k) * line, 0.0, 255.0));
      }
  }
  return planes;
}

void add_square(ColourPlanes& planes, std::size_t plane, int x0, int y0, int size) {
  for (int y = y0; y < y0 + size; ++y)
    for (int x = x0; x < x0 + size; ++x) planes.at(plane).at<std::uint8_t>(y, x) = 220;
}

TEST(LaserVote, IsForWhatIsLikeALineNotForWhatIsColourful) {
  ColourPlanes planes = room_with_line({10, 90, 10});  // green
  add_square(planes, 2, 20, 20, 60);
  add_square(planes, 2, 220, 120, 80);
  EXPECT_EQ(vote_for_laser(planes).plane, 1);
}

TEST(LaserVote, LightAroundOfTheOppositeColourDoesNotHideTheLaser) {
  // Red light that adds up to 60 levels is nowhere more red than blue.
  ColourPlanes planes = room_with_line({0, 0, 60}, {140, 110, 70});
  for (cv::Mat& plane : planes) plane(cv::Rect(240, 40, 40, 120)) = 255;  // a lamp
  EXPECT_EQ(vote_for_laser(planes).plane, 2);
  const LaserColour colour = where_laser_colour(planes, 2);
  for (const int y : {20, 120, 220}) {
    EXPECT_EQ(colour.where[static_cast<std::size_t>(y * 320 + 160)], LaserPlace::kSure) << y;
    EXPECT_EQ(colour.where[static_cast<std::size_t>(y * 320 + 120)], LaserPlace::kNone) << y;
  }
  for (int x = 230; x < 290; ++x) EXPECT_EQ(colour.where[static_cast<std::size_t>(100 * 320 + x)], 0) << x;
  EXPECT_EQ(vote_for_laser(room_with_line({0, 0, 0}, {140, 110, 70})).plane, -1);
}

TEST(LaserVote, AWhiteCoreHasTheColourOfItsRim) {
  for (std::size_t plane = 0; plane < 3; ++plane) {
    std::array<double, 3> laser = {300, 300, 300};  // crosstalk clips all three planes in the core
    laser.at(plane) = 1500;
    const LaserVote vote = vote_for_laser(room_with_line(laser));
    EXPECT_EQ(vote.plane, static_cast<int>(plane));
    EXPECT_TRUE(vote.clipped);
  }
}

TEST(LaserVote, AWhiteCoreIsSeenWhereverTheRangeOfTheCameraEnds) {
  const ColourPlanes full = room_with_line({300, 300, 1500});
  for (const auto& [scale, offset, blur] : {std::tuple{219.0 / 255, 16.0, 0.0},  // video range: 16 to 235
                                            std::tuple{0.6, 0.0, 0.0}, std::tuple{1.0, 0.0, 2.0}}) {
    ColourPlanes planes;
    for (std::size_t k = 0; k < 3; ++k) {
      full.at(k).convertTo(planes.at(k), CV_8U, scale, offset);
      if (blur > 0) cv::GaussianBlur(planes.at(k), planes.at(k), {}, blur);
    }
    const LaserVote vote = vote_for_laser(planes);
    EXPECT_EQ(vote.plane, 2) << scale;
    EXPECT_TRUE(vote.clipped) << scale << ' ' << blur;
    EXPECT_FALSE(vote.textured) << scale << ' ' << blur;
    EXPECT_EQ(where_laser_colour(planes, 2).rise[120 * 320 + 160], kClippedRise) << scale << ' ' << blur;
  }
}

TEST(LaserVote, DarkGrainsOfALineAreNoWhiteCore) {
  ColourPlanes planes = room_with_line({0, 0, 150});
  for (int y = 0; y < 240; y += 6)  // two rows of six hold half of the light
    for (int x = 130; x < 190; ++x)
      for (int k = 0; k < 2; ++k) {
        auto& pixel = planes[2].at<std::uint8_t>(y + k, x);
        pixel = static_cast<std::uint8_t>(60 + (pixel - 60) / 2);
      }
  EXPECT_FALSE(vote_for_laser(planes).clipped);
  const auto rise = where_laser_colour(planes, 2).rise;
  EXPECT_EQ(std::count(rise.begin(), rise.end(), kClippedRise), 0);
}

TEST(LaserVote, NothingWithoutColour) { EXPECT_EQ(vote_for_laser(room_with_line({90, 90, 90})).plane, -1); }

TEST(WhereLaserColour, IsSureOnTheLineWithItsClippedCoreAndNowhereElse) {
  const auto where = where_laser_colour(room_with_line({300, 300, 1500}), 2).where;
  for (int y = 0; y < 240; ++y) {
    const std::uint8_t* row = where.data() + static_cast<std::ptrdiff_t>(y) * 320;
    for (int x = 152; x <= 168; ++x) EXPECT_EQ(row[x], LaserPlace::kSure) << x << ' ' << y;
    for (const int x : {20, 100, 220, 300}) EXPECT_EQ(row[x], LaserPlace::kNone) << x << ' ' << y;
  }
}

/// 320 x 240, a checkerboard of white and black in room light, with a red stripe of 50 grey levels.
ColourPlanes board_with_red_line() {
  ColourPlanes planes;
  for (std::size_t k = 0; k < 3; ++k) {
    planes.at(k) = cv::Mat(240, 320, CV_8UC1);
    for (int y = 0; y < 240; ++y)
      for (int x = 0; x < 320; ++x) {
        const double ambient = (x / 25 + y / 25) % 2 == 0 ? 15 : 160;
        const double line =
            k == 2 ? 50 * std::exp(-0.5 * (x - 160 - 0.3 * y) * (x - 160 - 0.3 * y) / 9.0) : 0;
        planes.at(k).at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(ambient + line);
      }
  }
  return planes;
}

TEST(LaserVote, TellsALineOverAPrintThatOutshinesIt) {
  const LaserVote on_print = vote_for_laser(board_with_red_line());
  EXPECT_EQ(on_print.plane, 2);
  EXPECT_TRUE(on_print.textured);
  EXPECT_FALSE(on_print.clipped);
  EXPECT_FALSE(vote_for_laser(room_with_line({0, 0, 50})).textured);        // on plain grey
  EXPECT_FALSE(vote_for_laser(room_with_line({300, 300, 1500})).textured);  // clipped: the excess is hollow
}

TEST(LaserVote, WhiteGlintsOfTheLineItselfAreNoPrintUnderIt) {
  // Every other 12 rows the line's middle glints white, and nothing else is lit.
  ColourPlanes planes = room_with_line({0, 0, 60});
  for (int y = 0; y < 240; ++y)
    for (int x = 148; x < 172; ++x)
      for (ColourPlanes::value_type& plane : planes)
        plane.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(
            plane.at<std::uint8_t>(y, x) +
            (y / 12 % 2 == 0 ? 110 : 0) * std::exp(-0.5 * (x - 160) * (x - 160) / 16.0));
  const LaserVote vote = vote_for_laser(planes);
  EXPECT_EQ(vote.plane, 2);
  EXPECT_FALSE(vote.textured);
}

TEST(WhereLaserColour, ColouredFringesOfAnEdgeAreNoLaser) {
  // A white sheet on black, whose lower edge has a fringe of 12 grey levels of red: a lens does that.
  ColourPlanes planes = room_with_line({0, 0, 60});
  for (ColourPlanes::value_type& plane : planes) plane.rowRange(120, 240).setTo(220);
  planes[2].rowRange(120, 123).setTo(232);
  const auto where = where_laser_colour(planes, 2).where;
  for (const int x : {20, 100, 240, 300})
    EXPECT_EQ(where[static_cast<std::size_t>(121 * 320 + x)], LaserPlace::kNone) << x;
  EXPECT_EQ(where[static_cast<std::size_t>(60 * 320 + 160)], LaserPlace::kSure);
}

TEST(CountVotes, TexturedNeedsMoreThanHalf) {
  using C = Channel;
  EXPECT_EQ(count_votes(std::vector<C>{C::kRedTextured, C::kRedTextured, C::kRedLaser}), C::kRedTextured);
  EXPECT_EQ(count_votes(std::vector<C>{C::kRedTextured, C::kRedLaser}), C::kRedLaser);
  EXPECT_EQ(count_votes(std::vector<C>{C::kRedTextured, C::kRedClipped}), C::kRedClipped);
}

TEST(CountVotes, GreyAbstainsAndClippingIsSeenInAThird) {
  using C = Channel;
  EXPECT_EQ(count_votes(std::vector<C>{C::kGray, C::kGray, C::kRedLaser}), C::kRedLaser);
  EXPECT_EQ(count_votes(std::vector<C>{C::kRedLaser, C::kGreenLaser, C::kGreenLaser}), C::kGreenLaser);
  EXPECT_EQ(count_votes(std::vector<C>{C::kRedLaser, C::kRedClipped, C::kRedLaser}), C::kRedClipped);
  EXPECT_EQ(count_votes(std::vector<C>{}), C::kGray);
}

}  // namespace
}  // namespace lightstripe
