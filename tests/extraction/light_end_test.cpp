// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/light_end.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>

namespace lightstripe {
namespace {

std::array<double, kEndSamples> strengths_from(const LightEnd& light, double z, double level) {
  std::array<double, kEndSamples> strengths{};
  for (std::size_t k = 0; k < kEndSamples; ++k)
    strengths.at(k) = level * light.strength(z + static_cast<double>(k) / kEndSamplesPerSpread);
  return strengths;
}

TEST(LightEnd, IsFoundByTheStrengthsAlone) {
  for (const double tangent : {0.5, 1.0, 2.0})
    for (const double z : {-0.75, 0.0, 0.5, 1.25, 2.0}) {
      const LightEnd light{2, 1.4, tangent};  // between two widths of the tables
      const EndOfStrength fit = fit_light_end(light, strengths_from(light, z, 40));
      EXPECT_NEAR(fit.inside, z, z < 1.5 ? 0.13 : 0.5)
          << tangent << ' ' << z;  // the farther in, the less is seen
      EXPECT_LT(fit.misfit, 0.01);
    }
}

TEST(LightEnd, IsNotSeenWhereTheStrengthStays) {
  std::array<double, kEndSamples> even{};
  even.fill(7);
  EXPECT_GE(fit_light_end({2, 1.4, 1}, even).inside, kFarthestInside - 0.13);
}

TEST(LightEnd, SpeckleScattersTwiceTheVarianceWhereHalfTheKernelIsLit) {
  EXPECT_NEAR(LightEnd::scatter(0), std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(LightEnd::scatter(1), 1.14088, 1e-5);  // sqrt(Phi(sqrt 2)) / Phi(1)
  EXPECT_NEAR(LightEnd::scatter(4), 1, 1e-4);
}

TEST(LightEnd, CurvesAreThoseOfTheFormula) {
  for (const double width : {0.9, 1.7, 3.1})
    for (const double tangent : {0.5, 1.0, 2.0})
      for (const double z : {-0.9, 0.03, 0.77, 1.9}) {
        const LightEnd light{2.6, width, tangent};
        const EndInfluence influence = EndCurves(light).at(z);
        EXPECT_NEAR(influence.shift, light.shift(z), 0.06 * light.shift(z))
            << width << ' ' << tangent << ' ' << z;
        EXPECT_NEAR(influence.scatter, LightEnd::scatter(z), 0.01);
      }
  EXPECT_EQ(EndCurves(LightEnd{2, 1, 1}).at(20).shift, 0);
}

/// A blurred stripe that an edge cuts off, in closed form: a Gaussian across, times the lit share at each
/// place.
struct BlurredCut {
  double across2, turn, spread;
  BlurredCut(double width, double sigma, double tangent) : across2(width * width + sigma * sigma) {
    const double rho = width * width / across2;
    turn = tangent * rho;
    spread = sigma * std::sqrt(1 + tangent * tangent * rho);
  }
  double operator()(double x, double y) const {
    return std::exp(-0.5 * x * x / across2) * LightEnd::share((y + turn * x) / spread);
  }
};

/// Where Steger's ridge runs at the height y: the derivative along the Hessian's eigenvector vanishes.
double ridge_at(const BlurredCut& grey, double y) {
  constexpr double h = 1e-3;
  double x = 0;
  for (int i = 0; i < 300; ++i) {
    const double gx = (grey(x + h, y) - grey(x - h, y)) / (2 * h),
                 gy = (grey(x, y + h) - grey(x, y - h)) / (2 * h);
    const double xx = (grey(x + h, y) - 2 * grey(x, y) + grey(x - h, y)) / (h * h),
                 yy = (grey(x, y + h) - 2 * grey(x, y) + grey(x, y - h)) / (h * h),
                 xy = (grey(x + h, y + h) - grey(x + h, y - h) - grey(x - h, y + h) + grey(x - h, y - h)) /
                      (4 * h * h);
    const double eigenvalue = 0.5 * (xx + yy) - std::hypot(0.5 * (xx - yy), xy), ny = xy / (eigenvalue - yy);
    x -= 0.5 * (gx + ny * gy) / (xx + 2 * ny * xy + ny * ny * yy);
  }
  return x;
}

TEST(LightEnd, ShiftIsThatOfStegersRidge) {
  for (const auto& [width, sigma] : {std::pair{1.5, 1.5}, {1.5, 3.0}, {3.0, 3.0}})
    for (const double tangent : {1.0, 2.0})
      for (const double z : {1.0, 1.5, 2.0}) {
        const LightEnd light{sigma, width, tangent};
        const BlurredCut cut(width, sigma, tangent);
        EXPECT_NEAR(light.spread(), cut.spread, 1e-12);
        const double shift = ridge_at(cut, z * cut.spread);
        EXPECT_NEAR(tangent * light.shift(z), shift, 0.12 * shift)
            << width << ' ' << sigma << ' ' << tangent << ' ' << z;
      }
}

}  // namespace
}  // namespace lightstripe
