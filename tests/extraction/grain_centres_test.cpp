// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/grain_centres.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "extraction/extract_stripes.h"
#include "simulate/real_stripe.h"

namespace lightstripe {
namespace {

constexpr double kKernel = 2;  // of the stripe's standard deviation, as the finder chooses in grain

RealStripe slanted(double slope) {
  RealStripe stripe;
  stripe.width = stripe.height = 900;
  stripe.centre = [=](double y) { return 450.3 + slope * (y - 450); };
  stripe.shot_gain = 0;
  return stripe;
}

/// The true line, one point a row, clear of the picture's border.
LineSet true_line(const RealStripe& stripe) {
  LineSet lines;
  for (int y = 40; y < 860; ++y) {
    StripePoint p;
    p.x = stripe.centre(y), p.y = y;
    p.normal_x = stripe.cosine(y);
    p.normal_y = -std::copysign(std::sqrt(1 - p.normal_x * p.normal_x), stripe.centre(1) - stripe.centre(0));
    p.width = 2 * std::sqrt(3.0) * stripe.sigma;
    p.strength = 1;
    lines.points.push_back(p);
  }
  lines.lines.push_back({0, lines.points.size()});
  return lines;
}

double distance(const RealStripe& stripe, const StripePoint& p) {
  return (p.x - stripe.centre(p.y)) * stripe.cosine(p.y);
}

/// The true line after recentre_in_grain(); nothing if it stays.
std::optional<LineSet> recentred(const RealStripe& stripe, std::uint64_t seed, GrainWorkspace& w,
                                 int flags = 0) {
  const Image8 picture = picture_of(stripe, seed);
  const auto kernels = make_derivative_kernels(kKernel * stripe.sigma);
  LineSet lines = true_line(stripe);
  for (StripePoint& p : lines.points) p.flags = static_cast<decltype(p.flags)>(flags);
  RowScatterWorkspace rows;
  RowDifferences differences = look_at_rows(picture.view(), kernels, lines, lines.lines[0], rows);
  const CommonScatter common = common_scatter({&differences, 1});
  if (!recentre_in_grain(picture.view(), kernels, common, lines.lines[0], lines, differences, w, rows))
    return std::nullopt;
  return lines;
}

TEST(GrainCentres, NoSubPixelPlaceAndNoDirectionIsPreferred) {
  for (const double slope : {0.0, 0.05, 0.4, -0.9}) {
    RealStripe stripe = slanted(slope);
    stripe.speckle = {0.05, 1.2};
    stripe.read_noise = 0;
    GrainWorkspace w;
    const auto lines = recentred(stripe, 1, w);
    ASSERT_TRUE(lines) << slope;
    double sum = 0, worst = 0;
    for (const StripePoint& p : lines->points) {
      sum += distance(stripe, p);
      worst = std::max(worst, std::abs(distance(stripe, p)));
    }
    EXPECT_LT(std::abs(sum) / static_cast<double>(lines->points.size()), 0.003) << slope;
    EXPECT_LT(worst, 0.06) << slope;  // 4 sigma of what the grain leaves
  }
}

/// Variance of a shift by weights for a Gaussian of standard deviation 2 and peak 1, in noise of the variance
/// I^2 + noise^2. `kind`: 0 for the weights of least variance, 1 for the kernels'.
double variance_of(const GrainWeights& weights, std::size_t kind, double noise) {
  double square = 0, slope = 0;
  for (int i = -weights.half; i <= weights.half; ++i) {
    const double q = i / weights.per_px, light = std::exp(-q * q / 8);
    const double w = weights.taps[static_cast<std::size_t>(i + weights.half)].at(2 * kind);
    square += w * w * (light * light + noise * noise);
    slope += w * q / 4 * light;
  }
  return square / (slope * slope) * weights.per_px;
}

TEST(GrainCentres, NoOtherWeightsHaveLessVariance) {
  const auto kernels = make_derivative_kernels(kKernel * 2);
  for (const double noise : {0.05, 0.1, 0.25}) {
    const double least = variance_of(make_grain_weights(2, kernels, noise), 0, noise);
    EXPECT_GT(variance_of(make_grain_weights(2, kernels, noise), 1, noise), 1.2 * least) << noise;
    for (const double other : {0.5 * noise, 2 * noise})
      EXPECT_GT(variance_of(make_grain_weights(2, kernels, other), 0, noise), 1.01 * least) << noise;
    // Cauchy and Schwarz: 1 / the integral of I'^2 over the variance.
    double bound = 0;
    for (double q = -12; q < 12; q += 0.01) {
      const double light = std::exp(-q * q / 8);
      bound += 0.01 * std::pow(q / 4 * light, 2) / (light * light + noise * noise);
    }
    EXPECT_NEAR(least * bound, 1, 0.001) << noise;
  }
}

/// A shift of the profile shows as that shift by both kinds of weights.
TEST(GrainCentres, SlopesAreWhatAShiftAdds) {
  const GrainWeights weights = make_grain_weights(2, make_derivative_kernels(kKernel * 2), 0.1);
  for (const std::size_t kind : {0, 1}) {
    double shift = 0, slope = 0;
    for (int i = -weights.half; i <= weights.half; ++i) {
      const double q = i / weights.per_px - 0.05;
      const auto& tap = weights.taps[static_cast<std::size_t>(i + weights.half)];
      shift += tap.at(2 * kind) * std::exp(-q * q / 8);
      slope += tap.at(2 * kind + 1) * std::exp(-q * q / 8);
    }
    EXPECT_NEAR(shift / slope, 0.05, 0.0005) << kind;
  }
}

TEST(GrainCentres, RowsScatterLess) {
  RealStripe stripe = slanted(0);
  stripe.speckle = {0.25, 1.0};
  stripe.read_noise = 0.5;
  double by_weights = 0, by_kernels = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    GrainWorkspace w;
    ASSERT_TRUE(recentred(stripe, seed, w));
    for (const auto& row : w.rows) {
      if (!row.usable) continue;
      by_weights += row.centre * row.centre;
      by_kernels += std::pow(row.centre - row.difference, 2);
    }
  }
  // Grain that is small against the stripe would leave 0.38; this one is half as wide as it is.
  EXPECT_LT(by_weights, 0.6 * by_kernels);
}

TEST(GrainCentres, WhatIsNoGrainStaysWhereTheKernelsSeeIt) {
  GrainWorkspace w;
  RealStripe stripe = slanted(0.1);
  stripe.read_noise = 6;
  EXPECT_FALSE(recentred(stripe, 1, w));  // white noise
  stripe.read_noise = 1;
  stripe.speckle = {0.3, 1.2};
  EXPECT_TRUE(recentred(stripe, 1, w));
  // A white core has no profile: its points say so themselves.
  EXPECT_FALSE(recentred(stripe, 1, w, kStripeSaturated));
}

TEST(GrainCentres, NoiseIsToldFromGrainByWhatTheKernelsSee) {
  RowScatter scatter;
  scatter.grain_variance = 0.01;
  scatter.white_variance = 0.0003;
  EXPECT_NEAR(*noise_over_grain(scatter, 1, 2), std::sqrt(0.03 * std::pow(0.2, 1.5)), 1e-9);
  EXPECT_NEAR(*noise_over_grain(scatter, 1, 4), 0.05, 1e-9);  // no Gaussian's foot is fainter
  scatter.white_variance = scatter.grain_variance;
  EXPECT_FALSE(noise_over_grain(scatter, 1, 2));
  EXPECT_FALSE(noise_over_grain(RowScatter{}, 1, 2));
}

TEST(GrainCentres, PointsAreBetterAndSigmaSaysSo) {
  for (const double slope : {0.0, 0.4})
    for (const double contrast : {0.2, 0.4}) {
      RealStripe stripe = slanted(slope);
      stripe.speckle = {contrast, 1.2};
      stripe.read_noise = 1;
      ExtractionOptions options;
      options.sigma = kKernel * stripe.sigma;
      double actual = 0, predicted = 0, count = 0;
      for (std::uint64_t seed = 1; seed <= 4; ++seed)
        for (const Stripe& found : extract_stripes(picture_of(stripe, seed).view(), options).stripes)
          for (const StripePoint& p : found.points) {
            if (p.y < 40 || p.y > 860) continue;  // ends have errors of their own
            actual += std::pow(distance(stripe, p), 2);
            predicted += p.sigma_px * p.sigma_px;
            count += 1;
          }
      // 4 x 820 rows are some 400 independent points: 7 % for 1 sigma of the ratio.
      EXPECT_NEAR(actual / predicted, 1, 0.3) << slope << ' ' << contrast;
      RecordProperty("rms_px", std::to_string(std::sqrt(actual / count)));
    }
}

}  // namespace
}  // namespace lightstripe
