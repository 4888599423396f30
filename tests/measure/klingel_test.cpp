// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The wave of wheelsets whose answer is known; the integral goes in steps of 0.01 mm.
#include "measure/klingel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace lightstripe {
namespace {

RadiusDifference over(const std::function<double(double)>& delta_r) {
  RadiusDifference difference;
  difference.first_mm = -8;
  for (int i = 0; i <= 160; ++i) difference.delta_r_mm.push_back(delta_r(-8 + 0.1 * i));
  return difference;
}

TEST(Klingel, AConeIsItsOwnEquivalent) {
  const KlingelWave wave(over([](double y) { return 2 * 0.05 * y; }));
  for (const double amplitude : {1.0, 3.0, 6.0}) EXPECT_NEAR(*wave.tan_gamma_e(amplitude), 0.05, 5e-5);
  EXPECT_NEAR(*wave.middle_mm(), 0, 1e-9);
}

TEST(Klingel, AnOffCentreConeRunsAboutItsMiddle) {
  const KlingelWave wave(over([](double y) { return 2 * 0.1 * (y - 1.5); }));
  EXPECT_NEAR(*wave.middle_mm(), 1.5, 0.011);
  EXPECT_NEAR(*wave.tan_gamma_e(3), 0.1, 5e-4);
}

TEST(Klingel, ACubicSpringHasTheWaveOfItsIntegral) {
  // delta_r = 2 c y^3: the period of y'' = -(c / e r0) y^3 at amplitude A is 7.4163 / (A sqrt(c / e r0)), so
  // that tan gamma_e = (2 pi / 7.4163)^2 c A^2 (7.4163 = 4 K(1/sqrt 2), Landau and Lifshitz, Mechanics, 11).
  const double c = 0.004;
  const KlingelWave wave(over([&](double y) { return 2 * c * y * y * y; }));
  for (const double amplitude : {2.0, 4.0, 6.0})
    EXPECT_NEAR(*wave.tan_gamma_e(amplitude) /
                    (std::pow(2 * std::acos(-1.0) / 7.416299, 2) * c * amplitude * amplitude),
                1, 0.003)
        << amplitude;
}

TEST(Klingel, NothingBeyondWhatIsKnownOrWithoutAWave) {
  const KlingelWave cone(over([](double y) { return 0.1 * y; }));
  EXPECT_FALSE(cone.tan_gamma_e(9));
  const KlingelWave runs_away(over([](double y) { return -0.1 * y; }));
  EXPECT_FALSE(runs_away.tan_gamma_e(3));
}

}  // namespace
}  // namespace lightstripe
