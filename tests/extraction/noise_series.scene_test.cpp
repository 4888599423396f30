// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The accuracy series of Chen, Zhang, Sun 2013, figure 5: one stripe in growing noise.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "extraction/extract_stripes.h"
#include "stripe_scenes.h"

namespace lightstripe {
namespace {

struct Series {
  double rms = 0, predicted = 0;  ///< px
  double least_found = 1;         ///< share of the rows, in the worst image
  std::size_t lines = 0;
};

Series run(double noise_share, bool smoothing, int trials) {
  ExtractionOptions options;
  options.sigma = scenes::kFigure5Sigma;
  options.smoothing = smoothing ? Smoothing::kAlways : Smoothing::kNever;
  Series series;
  int points = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const auto r = extract_stripes(
        scenes::figure5_stripe(noise_share, Random(static_cast<std::uint64_t>(trial))).view(), options);
    std::set<long> rows;
    series.lines += r.stripes.size();
    for (const Stripe& s : r.stripes)
      for (const StripePoint& p : s.points) {
        series.rms += (p.x - scenes::kFigure5Centre) * (p.x - scenes::kFigure5Centre);
        series.predicted += p.sigma_px * p.sigma_px;
        ++points;
        if (std::abs(p.x - scenes::kFigure5Centre) < 2) rows.insert(std::lround(p.y));
      }
    series.least_found =
        std::min(series.least_found, static_cast<double>(rows.size()) / scenes::kFigure5Size);
  }
  series.rms = std::sqrt(series.rms / points);
  series.predicted = std::sqrt(series.predicted / points);
  return series;
}

// 512 rows hold some 57 independent errors: over 15 images 1 sigma of an rms is 2.4 %.
constexpr int kTrials = 15;

TEST(NoiseSeries, PlainScatterIsTheFormulasUpToClippingAndNonlinearity) {
  // 0.564 noise / A; clipping at 0 and 255 widens the profile, and from 0.25 on t is no longer linear in the
  // noise.
  for (const double noise : {0.05, 0.20, 0.40}) {
    const Series s = run(noise, false, kTrials);
    EXPECT_EQ(s.lines, static_cast<std::size_t>(kTrials)) << noise;
    EXPECT_GE(s.least_found, 0.995) << noise;
    EXPECT_LE(s.rms, (noise < 0.1 ? 1.12 : 1.18) * 0.564 * noise) << noise;
  }
}

TEST(NoiseSeries, SmoothingAlongTheLineHalvesIt) {
  const Series low = run(0.05, true, kTrials), high = run(0.40, true, kTrials);
  EXPECT_LE(low.rms, 0.015);
  EXPECT_LE(high.rms, 0.12);
  for (const Series& s : {low, high}) {
    EXPECT_EQ(s.lines, static_cast<std::size_t>(kTrials));
    EXPECT_GE(s.least_found, 0.995);
  }
  EXPECT_NEAR(low.rms / low.predicted, 1.0, 0.25);
}

TEST(NoiseSeries, TheWidthIsFoundInNoiseAsWell) {
  for (const double noise : {0.1, 0.3}) {
    const auto r = extract_stripes(scenes::figure5_stripe(noise, Random(5)).view());
    ASSERT_EQ(r.stripes.size(), 1U) << noise;
    // Clipping takes the noise of the dark side away and widens the stripe.
    EXPECT_NEAR(r.sigma / scenes::kFigure5Sigma, 1.1, 0.4) << noise;
  }
}

}  // namespace
}  // namespace lightstripe
