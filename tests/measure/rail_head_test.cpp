// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/rail_head.h"

#include <gtest/gtest.h>

#include <cmath>

#include "block.h"

namespace lightstripe {
namespace {

/// The block's head with `lowered` mm off its top.
OnBlock head(double lowered, double spacing = 0.2) {
  OnBlock block;
  for (double v = -65; v < -lowered; v += spacing) block.add(20, v), block.add(-20, v);
  for (double u = -20; u <= 20; u += spacing) block.add(u, -lowered);
  return block;
}

TEST(HeadAreaLoss, IsWidthTimesHeightOfWhatIsGone) {
  EXPECT_NEAR(*head_area_loss(head(0).placed()).value, 0, 0.05);
  EXPECT_NEAR(*head_area_loss(head(1).placed()).value, 40, 0.8);  // sectors of 1 deg cut the two corners
}

TEST(HeadAreaLoss, ALargeHoleLeavesItUnknown) {
  OnBlock block = head(1);
  std::erase_if(block.section, [](const SectionPoint& p) { return std::abs(p.position.x()) < 4; });
  EXPECT_EQ(head_area_loss(block.placed()).reason, "head not seen all round");
}

// v = 0.02 u - u^2 / 600 is highest at u = 6, v = 0.06.
TEST(HeadTop, IsTheVertexOfTheCrown) {
  OnBlock block;
  for (double u = -20; u <= 20; u += 0.2) block.add(u, 0.02 * u - u * u / 600);
  const HeadTop top = find_head_top(block.placed());
  EXPECT_EQ(top.reason, "");
  EXPECT_NEAR(top.u, 6, 0.02);
  EXPECT_NEAR(top.v, 0.06, 1e-3);
  OnBlock faces;
  for (double v = -60; v < -20; v += 0.2) faces.add(20, v);
  EXPECT_EQ(find_head_top(faces.placed()).reason, "top of the head not seen");
}

TEST(HeadFace, StraightFacesAreCarriedUp) {
  OnBlock block;
  for (double v = -25; v <= -10; v += 0.2) block.add(19.5, v);
  const SurfaceFit face = fit_head_face(block.placed(), {0, -14}, {1, 0});
  ASSERT_TRUE(face.known()) << face.reason;
  EXPECT_NEAR(face.along_mm, 19.5, 1e-6);
  EXPECT_NEAR(face.wear_mm, 0.5, 1e-6);
  EXPECT_GT(face.num_points, 30);  // of the 7 mm below, not of the 3 mm about the height
  EXPECT_FALSE(fit_head_face(block.placed(), {0, -14}, {-1, 0}).known());
}

TEST(Lip, IsWhatStandsOutOfTheFaceOnItsSide) {
  OnBlock block = head(0);
  for (const double v : {-30.0, -30.2, -30.4, -30.6}) block.add(20.8, v);
  block.add(23, -31);  // one point alone is none
  EXPECT_NEAR(*find_lip(block.placed(), 1, 0.5).value, 0.8, 1e-9);
  EXPECT_EQ(*find_lip(block.placed(), 1, 1.0).value, 0);
  EXPECT_EQ(*find_lip(block.placed(), -1, 0.5).value, 0);
}

}  // namespace
}  // namespace lightstripe
