// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/track_gauge.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "io/nominal_outlines.h"
#include "sections.h"

namespace lightstripe {
namespace {

class TrackGauge : public ::testing::Test {
 protected:
  const ReferenceShape reference{"60E1", ObjectKind::kRail, read_nominal("60E1")};

  /// Two rails whose axes stand 1507 mm apart and are off by these.
  Estimate between(double left_off, double right_off, double noise, std::uint64_t seed,
                   std::optional<double> rig_sigma) const {
    const Section left =
        rail_section(reference.outline(), {.noise_mm = noise, .shift = {753.5 + left_off, 0}, .seed = seed});
    const Section right = rail_section(
        reference.outline(), {.noise_mm = noise, .shift = {-753.5 + right_off, 0}, .seed = seed + 1000});
    const Registration at_left = register_section(left, reference),
                       at_right = register_section(right, reference);
    return track_gauge(place(left, reference, at_left), place(right, reference, at_right), {}, rig_sigma);
  }
};

// The new rail's face lies 36 mm from its axis 14 mm below its top.
TEST_F(TrackGauge, IsTheDistanceOfTheFaces) {
  const Estimate gauge = between(0, 0, 0, 1, std::nullopt);
  EXPECT_NEAR(gauge.value.value_or(0), 1507 - 71.963, 0.005);
  EXPECT_FALSE(gauge.sigma);
}

// Each rail's place errs by the rig's sigma on its own: 40 repeats know the variance to 22 %.
TEST_F(TrackGauge, SigmaHasTheRigsPartOfBothRails) {
  constexpr int kRepeats = 40;
  constexpr double kRigMm = 0.1;
  Random random(9);
  double squares = 0, predicted = 0;
  for (int i = 0; i < kRepeats; ++i) {
    const Estimate gauge = between(kRigMm * random.gaussian(), kRigMm * random.gaussian(), 0.01,
                                   static_cast<std::uint64_t>(i + 1), kRigMm);
    squares += std::pow(*gauge.value - (1507 - 71.963), 2) / kRepeats;
    predicted += *gauge.sigma * *gauge.sigma / kRepeats;
  }
  EXPECT_NEAR(std::sqrt(predicted), std::sqrt(2.0) * kRigMm, 0.01);
  EXPECT_GT(squares / predicted, 0.6);
  EXPECT_LT(squares / predicted, 1.6);
}

}  // namespace
}  // namespace lightstripe
