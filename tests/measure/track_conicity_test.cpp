// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/track_conicity.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "io/nominal_outlines.h"
#include "rolling_outlines.h"
#include "sections.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using ::testing::HasSubstr;

constexpr double kLean = 1.43210;  // 1:40
// Of 60E1 at 1:40 the highest point lies 7.497 towards the field, the gauge point 43.03 further in.
constexpr double kHalfMm = 753.033;  // so that the gauge is 1435

class TrackConicity : public ::testing::Test {
 protected:
  const ReferenceShape reference{"60E1", ObjectKind::kRail, read_nominal("60E1")};
  ReferenceWheelset wheelset{{s1002_wheel(), s1002_wheel()}, {}};

  struct Rails {
    Section left, right;
  };
  Rails rails(double noise, std::uint64_t seed) const {
    return {
        rail_section(reference.outline(),
                     {.noise_mm = noise, .turn_deg = kLean, .shift = {kHalfMm, 40}, .seed = seed}),
        rail_section(reference.outline(),
                     {.noise_mm = noise, .turn_deg = -kLean, .shift = {-kHalfMm, 40}, .seed = seed + 1000})};
  }
  Conicity of(const Rails& rails, std::optional<double> rig_sigma = 0.0) const {
    const Registration at_left = register_section(rails.left, reference),
                       at_right = register_section(rails.right, reference);
    const PlacedSection left = place(rails.left, reference, at_left),
                        right = place(rails.right, reference, at_right);
    return conicity_of_track(left, right, find_track_plane(left, right, {}, rig_sigma), wheelset, {});
  }
};

// The outlines' own value at this gauge, see conicity_test.cpp.
TEST_F(TrackConicity, OfNewRailsIsThatOfTheirOutlines) {
  const Conicity conicity = of(rails(0.001, 1));
  ASSERT_TRUE(conicity.usable()) << conicity.reason;
  EXPECT_NEAR(conicity.at_3_mm.value_or(0), 0.174, 0.003);
}

TEST_F(TrackConicity, HeadRunsFromTheGaugeFaceOutwards) {
  const Rails both = rails(0, 1);
  const Registration at = register_section(both.right, reference),
                     at_left = register_section(both.left, reference);
  const PlacedSection left = place(both.left, reference, at_left), right = place(both.right, reference, at);
  const TrackPlane track = find_track_plane(left, right, {}, {});
  for (const auto& [rail, side] : {std::pair{&left, TrackSide::kLeft}, {&right, TrackSide::kRight}}) {
    const RailHead head = rail_head_of(*rail, track, side, 14);
    ASSERT_EQ(head.reason, "");
    EXPECT_NEAR(head.points.front().y(), -16, 0.5);
    EXPECT_NEAR(head.points.front().x(), -0.05, 0.1);  // a face at 1:20 leans out by 0.1 on 2 mm, less 1:40
    double top = -1;
    for (const Vector2d& p : head.points) top = std::max(top, p.y());
    EXPECT_NEAR(top, 0, 0.005);
    EXPECT_LT(head.variance_share, 0.8);  // both sensors see the crown
  }
}

// 0.3 mm off, as where glare has moved a point.
TEST_F(TrackConicity, AStrayPointDoesNotCount) {
  Rails both = rails(0.001, 3);
  const double clean = of(both).at_3_mm.value_or(0);
  int moved = 0;
  for (std::size_t i = 0; i < both.left.size(); i += 40)
    if (both.left[i].position.y() > 30) both.left[i].position.y() += 0.3, ++moved;
  ASSERT_GT(moved, 4);
  EXPECT_NEAR(of(both).at_3_mm.value_or(0), clean, 0.003);
}

TEST_F(TrackConicity, AHoleWhereWheelsRollIsNamed) {
  Rails both = rails(0.001, 1);
  std::erase_if(both.right, [](const SectionPoint& p) {
    return p.position.y() > 10 && std::abs(p.position.x() + kHalfMm - 5) < 4;
  });
  const Conicity conicity = of(both);
  EXPECT_FALSE(conicity.usable());
  EXPECT_THAT(conicity.reason, HasSubstr("right rail has a hole where wheels roll"));
}

// The predicted error against the scatter of repeats, the gauge's part from the rig included: each rail
// stands off by the rig's error. 30 repeats know the variance to 26 %; a sigma scaled by 0.7 or 1.4 changes
// the ratio by a factor of 2.
TEST_F(TrackConicity, PredictedSigmaIsTheScatterOfRepeats) {
  constexpr int kRepeats = 30;
  constexpr double kRigMm = 0.15, kNoiseMm = 0.015;
  wheelset.options.to_mm = 4, wheelset.options.draws = 20;
  Random random(5);
  double sum = 0, squares = 0, predicted = 0;
  for (int i = 0; i < kRepeats; ++i) {
    Rails both = rails(kNoiseMm, static_cast<std::uint64_t>(i + 1));
    for (Section* rail : {&both.left, &both.right}) {
      const double off = kRigMm * random.gaussian();
      for (SectionPoint& p : *rail) p.position.x() += off;
    }
    const Conicity conicity = of(both, kRigMm);
    ASSERT_TRUE(conicity.at_3_mm && conicity.at_3_mm_sigma) << conicity.reason;
    sum += *conicity.at_3_mm, squares += *conicity.at_3_mm * *conicity.at_3_mm;
    predicted += *conicity.at_3_mm_sigma * *conicity.at_3_mm_sigma / kRepeats;
  }
  const double ratio = (squares - sum * sum / kRepeats) / (kRepeats - 1) / predicted;
  RecordProperty("ratio", std::to_string(ratio));
  EXPECT_GT(ratio, 0.6);
  EXPECT_LT(ratio, 1.6);
}

}  // namespace
}  // namespace lightstripe
