// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/follow/direction_guided.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightstripe {
namespace {

constexpr int kWidth = 200, kHeight = 160;

double line_at(double x, double start) { return start + 0.3 * x; }

/// Two parallel Gaussian lines of sigma 2 px, the second one half as bright.
class FollowLines : public ::testing::Test {
 protected:
  Image8 image = [] {
    Image8 out(kWidth, kHeight);
    const double length = std::hypot(1, 0.3);
    const auto bar = [&](double x, double y, double start) {
      return std::exp(-std::pow((y - line_at(x, start)) / length, 2) / 8);
    };
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        out(x, y) = static_cast<std::uint8_t>(std::lround(10 + 200 * bar(x, y, 20) + 100 * bar(x, y, 70)));
    return out;
  }();
  DerivativeKernels kernels = make_derivative_kernels(2);
  RidgeLimits limits = [] {
    RidgeLimits out;
    out.level_low = 30, out.level_high = 60, out.start_contrast = 5;
    out.start_strength = 1, out.follow_strength = 0.5, out.shaded_strength = 0.7;
    return out;
  }();
  FollowRule rule = [] {
    FollowRule out;
    out.brightest = 210, out.least_length = 30;
    return out;
  }();
  DirectionGuidedWorkspace<std::uint8_t> workspace;

  LineSet follow() {
    LineSet lines;
    follow_lines(image.view(), kernels, limits, rule, workspace, lines);
    return lines;
  }
  /// Distance of all points from the line that begins at `start`, px, at the most.
  static double farthest(const LineSet& lines, std::size_t k, double start) {
    double most = 0;
    for (std::size_t i = lines.lines[k].begin; i < lines.lines[k].end; ++i)
      most = std::max(most, std::abs(lines.points[i].y - line_at(lines.points[i].x, start)));
    return most;
  }
};

TEST_F(FollowLines, TheBrighterLineFirstEachFromBorderToBorder) {
  const LineSet lines = follow();
  ASSERT_EQ(lines.lines.size(), 2U);
  for (const std::size_t k : {0, 1}) {
    EXPECT_GE(lines.lines[k].size(), 198U);
    EXPECT_LE(lines.lines[k].size(), 200U);
    EXPECT_LT(farthest(lines, k, k == 0 ? 20 : 70), 0.05);  // whole grey levels
    for (std::size_t i = lines.lines[k].begin + 1; i < lines.lines[k].end; ++i)
      ASSERT_EQ(std::abs(lines.points[i].x - lines.points[i - 1].x), 1);
  }
}

TEST_F(FollowLines, AHintChoosesTheLineAndOneIsEnough) {
  rule.has_start = true, rule.start_x = 100, rule.start_y = line_at(100, 70) + 6, rule.stop_after = 1;
  const LineSet lines = follow();
  ASSERT_EQ(lines.lines.size(), 1U);
  EXPECT_LT(farthest(lines, 0, 70), 0.05);
}

TEST_F(FollowLines, NothingBelowTheLevelBegins) {
  limits.level_low = 130;  // the second line's top is 110
  const LineSet lines = follow();
  ASSERT_EQ(lines.lines.size(), 1U);
  EXPECT_LT(farthest(lines, 0, 20), 0.05);
}

TEST_F(FollowLines, ACrowdOfCrumbsEndsTheSearch) {
  constexpr int kApart = 24, kRowsApart = 12, kLong = 16;
  int dashes = 0;
  for (int y = 112; y + 4 < kHeight; y += kRowsApart)
    for (int x = 4; x + kLong < kWidth; x += kApart, ++dashes)
      for (int k = 0; k < kLong * 5; ++k) {
        const int aside = k / kLong - 2;
        image(x + k % kLong, y + aside) += static_cast<std::uint8_t>(60 * std::exp(-aside * aside / 4.0));
      }
  ASSERT_GT(dashes, 25);
  const LineSet lines = follow();
  ASSERT_GE(lines.lines.size(), 2U);
  EXPECT_LT(farthest(lines, 0, 20), 0.05);
  EXPECT_LT(lines.lines.size(), 15U);
}

TEST_F(FollowLines, NothingBeginsWhereTheLasersColourIsNot) {
  image.where.assign(static_cast<std::size_t>(kWidth) * kHeight, LaserPlace::kNone);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      if (y > line_at(x, 45)) image.where[static_cast<std::size_t>(y * kWidth + x)] = LaserPlace::kSure;
  const LineSet lines = follow();
  ASSERT_EQ(lines.lines.size(), 1U);
  EXPECT_LT(farthest(lines, 0, 70), 0.05);
}

}  // namespace
}  // namespace lightstripe
