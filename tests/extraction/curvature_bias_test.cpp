// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/curvature_bias.h"

#include <gtest/gtest.h>

#include <cmath>

#include "extraction/extract_stripes.h"
#include "simulate/real_stripe.h"
#include "stripe_scenes.h"

namespace lightstripe {
namespace {

struct Arc {
  double radius, sigma = 2.0, peak = 160, noise = 0.5;
};

/// Mean distance to the centre of the points on an arc of 140 degrees, away from its ends, minus the true
/// radius.
double arc_error(const Arc& arc, bool corrected, std::uint64_t seed = 3) {
  const double radius = arc.radius;
  scenes::Canvas canvas(200, 200, 4);
  canvas.add(scenes::make_curve([&](double u) {
    const double a = 0.3 + 2.44 * u;
    return scenes::CurvePoint{100.3 + radius * std::cos(a), 99.8 + radius * std::sin(a), arc.peak, 2.0};
  }));
  ExtractionOptions options;
  options.sigma = arc.sigma;
  options.curvature_correction = corrected;
  const auto r = extract_stripes(canvas.exposed(arc.noise, 0, seed).view(), options);
  double sum = 0;
  int count = 0;
  for (const Stripe& s : r.stripes)
    for (const StripePoint& p : s.points) {
      const double a = std::atan2(p.y - 99.8, p.x - 100.3);
      if (a < 0.3 + 12 / radius || a > 2.74 - 12 / radius) continue;
      sum += std::hypot(p.x - 100.3, p.y - 99.8) - radius;
      ++count;
    }
  EXPECT_GE(count, 20);
  return sum / count;
}

TEST(CurvatureBias, SmoothedRingsShrinkBySigmaSquaredOverTwiceTheRadius) {
  // sigma^2 / (2 r) = 0.05 px at r = 40; the next order is good for 15 %.
  EXPECT_NEAR(arc_error({40}, false), -0.05, 0.008);
}

TEST(CurvatureBias, IsTakenBackOnRings) {
  for (const double radius : {25.0, 40.0, 80.0})
    EXPECT_NEAR(arc_error({radius}, true), 0, 0.15 * 2.0 / radius + 0.002) << radius;
}

TEST(CurvatureBias, IsTakenBackInStrongNoiseAsWell) {
  // Broad kernels, as grain asks for: 16 / (2 * 80) = 0.1 px, where one parabola over 3 sigma to both sides
  // can hardly tell the bend from the noise.
  const Arc arc{80, 4, 40, 20};
  double with = 0, without = 0;
  constexpr int kSeeds = 12;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    with += arc_error(arc, true, seed) / kSeeds;
    without += arc_error(arc, false, seed) / kSeeds;
  }
  EXPECT_NEAR(without, -0.1, 0.03);
  EXPECT_NEAR(with, 0, 0.02);  // -0.037 by one parabola
}

TEST(CurvatureBias, StraightNoisyLinesAreHardlyMoved) {
  // The correction may add at most 5 % to the scatter of a straight line.
  double with = 0, without = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    scenes::Canvas canvas(500, 120, 6);
    canvas.add(scenes::make_line(10, 30, 490, 85, 60, 2.5));
    const Image8 image = canvas.exposed(4, 0, seed);
    for (const bool corrected : {true, false}) {
      ExtractionOptions options;
      options.sigma = 2.5;
      options.curvature_correction = corrected;
      const auto r = extract_stripes(image.view(), options);
      ASSERT_EQ(r.stripes.size(), 1U);
      for (const StripePoint& p : r.stripes[0].points) {
        const double d = ((p.y - 30) * 480 - (p.x - 10) * 55) / std::hypot(480, 55);
        (corrected ? with : without) += d * d;
      }
    }
  }
  EXPECT_LE(std::sqrt(with / without), 1.05);
}

TEST(CurvatureBias, OfClippedBarsIsCorrectedLessExactlyAndSigmaSaysSo) {
  for (const double exposure : {1.5, 6.0, 15.0, 60.0}) {
    RealStripe stripe;
    stripe.sigma = 4;
    stripe.exposure = exposure;
    RealScore score;
    for (std::uint64_t seed = 100; seed < 104; ++seed)
      add_to(score, stripe, extract_stripes(picture_of(stripe, seed).view()).stripes);
    EXPECT_LT(score.rms_surprise(), 2.0) << exposure;
    EXPECT_LT(score.rms(), 0.025) << exposure;
    EXPECT_LT(score.sigma(), 0.055) << exposure;  // 0.042 at the most, but for the picture's border
  }
}

}  // namespace
}  // namespace lightstripe
