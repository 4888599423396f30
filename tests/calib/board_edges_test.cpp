// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/board/board_edges.h"

#include <gtest/gtest.h>

namespace lightstripe {
namespace {

using Eigen::Vector2d;

const Target kSquares{TargetType::kCheckerboard, 11, 8, 10, 12};

TEST(NearestEdges, OfSquaresLieAtTheirPitch) {
  const auto edges = nearest_edges(kSquares, {23, 25.5});
  EXPECT_NEAR(edges[0].distance_mm, 3, 1e-9);
  EXPECT_NEAR(edges[1].distance_mm, 1.5, 1e-9);
  EXPECT_NEAR(std::abs(edges[0].across.x()), 1, 1e-9);
  EXPECT_NEAR(std::abs(edges[1].across.y()), 1, 1e-9);
}

TEST(NearestEdges, OfCirclesIsTheRim) {
  Target circles{TargetType::kCircles, 7, 7, 20, 20};
  circles.circle_mm = 10;
  for (const auto& edge : nearest_edges(circles, {41, 20})) {  // 1 mm beside a middle
    EXPECT_NEAR(edge.distance_mm, 4, 1e-9);
    EXPECT_NEAR(std::abs(edge.across.x()), 1, 1e-9);
  }
}

TEST(CarriesStripes, PatternAndRimDoAndBeyondDoesNot) {
  Target target = kSquares;
  target.rim_mm = 7;
  EXPECT_TRUE(carries_stripes(target, {50, 40}));
  EXPECT_FALSE(on_rim(target, {50, 40}));
  // The outer squares end a pitch beyond the corners, the rim 7 mm beyond these.
  EXPECT_FALSE(on_rim(target, {-9, 40}));
  EXPECT_TRUE(on_rim(target, {-12, 40}));
  EXPECT_TRUE(carries_stripes(target, {-16, 40}));
  EXPECT_FALSE(carries_stripes(target, {-18, 40}));
  target.rim_mm = 0;
  EXPECT_FALSE(carries_stripes(target, {-12, 40}));
}

}  // namespace
}  // namespace lightstripe
