// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/reference_shape.h"

#include <gtest/gtest.h>

#include "block.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

TEST(ReferenceShape, FeetDistancesAndZonesOfABlock) {
  const ReferenceShape block = block_shape();
  EXPECT_EQ(block.top_v(), 0);
  const auto right = block.nearest({22, -30}), top = block.nearest({3, 2.5}), inside = block.nearest({0, -2}),
             below = block.nearest({-21, -80});
  ASSERT_TRUE(right && top && inside && below);
  EXPECT_NEAR((right->position - Vector2d(20, -30)).norm(), 0, 1e-9);
  EXPECT_NEAR(right->signed_distance, 2, 1e-9);
  EXPECT_NEAR((top->position - Vector2d(3, 0)).norm(), 0, 1e-9);
  EXPECT_NEAR(inside->signed_distance, -2, 1e-9);
  EXPECT_FALSE(right->beyond_end);
  EXPECT_EQ(block.zone(*right), Zone::kFaceRight);
  EXPECT_EQ(block.zone(*top), Zone::kRunning);
  EXPECT_EQ(block.zone(*below), Zone::kBelowLeft);
  EXPECT_FALSE(block.nearest({30, -30}));  // 10 mm away
}

TEST(ReferenceShape, ArcLengthIsMeasuredAlongTheOutline) {
  const ReferenceShape block = block_shape();
  const double at_40 = block.arc_length(*block.nearest({21, -40})),
               at_30 = block.arc_length(*block.nearest({21, -30})),
               on_top = block.arc_length(*block.nearest({5, 1}));
  EXPECT_NEAR(at_30 - at_40, 10, 1e-6);
  EXPECT_NEAR(on_top - at_30, 30 + 15, 1e-6);  // round the corner
}

TEST(ReferenceShape, TheCoarseMapKnowsDistancesToAMillimetre) {
  const ReferenceShape block = block_shape();
  for (const double out : {0.0, 3.0, 10.0, 18.0}) EXPECT_NEAR(block.coarse_distance({20 + out, -50}), out, 1);
  EXPECT_EQ(block.coarse_distance({500, 0}), 20);
}

TEST(ReferenceShape, RaysFromOutsideMeetTheSurface) {
  const ReferenceShape block = block_shape();
  EXPECT_NEAR(*block.surface_along({0, 0}, {0, 1}, 5), 0, 1e-9);
  EXPECT_NEAR(*block.surface_along({0, -30}, {1, 0}, 0), 20, 1e-9);
  EXPECT_NEAR(*block.surface_along({4, -30}, {-1, 0}, 0), 24, 1e-9);
  EXPECT_FALSE(block.surface_along({0, 0}, {0, 1}, 25));
}

TEST(OutlineOfSection, DoubledPointsAreOneAndTheChainIsOpen) {
  Section section;
  for (int i = 0; i < 12; ++i) section.push_back({Vector2d(i, 0)});
  section.push_back({Vector2d(11, 1e-4)});
  const Outline chain = outline_of_section(section);
  EXPECT_EQ(chain.segments.size(), 11U);
  EXPECT_FALSE(chain.closed());
  const ReferenceShape shape("chain", ObjectKind::kRail, chain);
  EXPECT_TRUE(shape.nearest({-2, 0.5})->beyond_end);
  EXPECT_FALSE(shape.nearest({2, 0.5})->beyond_end);
}

}  // namespace
}  // namespace lightstripe
