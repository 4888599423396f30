// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/row_scatter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "extraction/extract_stripes.h"
#include "simulate/real_stripe.h"

namespace lightstripe {
namespace {

RealStripe straight(double contrast, double grain) {
  RealStripe stripe;
  stripe.centre = [](double) { return 80.3; };
  stripe.height = 2000;
  stripe.speckle = {contrast, grain};
  stripe.shot_gain = 0;
  return stripe;
}

/// Of the line that the kernels follow.
RowScatter measured(const RealStripe& stripe) {
  const Image8 picture = picture_of(stripe, 5);
  ExtractionOptions options;
  options.sigma = stripe.sigma;
  options.on_pattern = true;  // else grain_centres moves the line to where other weights see it
  const auto result = extract_stripes(picture.view(), options);
  LineSet lines;
  if (!result.stripes.empty()) lines.points = result.stripes.front().points;
  lines.lines.push_back({0, lines.points.size()});
  RowScatterWorkspace w;
  return measure_row_scatter(picture.view(), make_derivative_kernels(stripe.sigma), lines, lines.lines[0], w);
}

TEST(RowScatter, WhiteNoiseIsFoundWhiteAndOfTheClosedFormulasSize) {
  RealStripe stripe = straight(0, 1);
  stripe.read_noise = 6;
  const RowScatter scatter = measured(stripe);
  EXPECT_EQ(scatter.grain_variance, 0);
  // 0.564 noise / A: extraction.md, "Bounds". 2000 rows: 4 % (1 sigma of the variance).
  EXPECT_NEAR(std::sqrt(scatter.white_point(stripe.sigma)) / (0.564 * 6 / stripe.peak), 1, 0.1);
}

TEST(RowScatter, SpeckleShowsItsGrain) {
  for (const double grain : {0.8, 1.6, 2.4}) {
    const RowScatter scatter = measured(straight(0.25, grain));
    EXPECT_GT(scatter.grained_point(2), 10 * scatter.white_point(2)) << grain;
    EXPECT_NEAR(scatter.grain_px / grain, 1, 0.25) << grain;
  }
}

// A row that crosses the line obliquely looks at it by a smaller scale: white noise is stronger there by the
// one law, speckle by the other.
TEST(RowScatter, ObliqueLinesAreJudgedAsUprightOnes) {
  for (const double slope : {0.5, -0.5, 0.9, -0.9})
    for (const double contrast : {0.0, 0.3})
      for (const double kernel : {1.0, 2.0}) {
        RealStripe stripe = straight(contrast, 1.2);
        stripe.read_noise = contrast > 0 ? 1 : 8;
        stripe.height = 900;
        stripe.width = 900;
        stripe.centre = [=](double y) { return 450.3 + slope * (y - 450); };
        ExtractionOptions options;
        options.sigma = kernel * stripe.sigma;
        double actual = 0, predicted = 0;
        for (std::uint64_t seed = 1; seed <= 3; ++seed)
          for (const Stripe& found : extract_stripes(picture_of(stripe, seed).view(), options).stripes)
            for (const StripePoint& p : found.points) {
              if (p.y < 40 || p.y > 860) continue;  // ends have errors of their own
              actual += std::pow((p.x - stripe.centre(p.y)) * stripe.cosine(p.y), 2);
              predicted += p.sigma_px * p.sigma_px;
            }
        // 3 x 820 rows are some 300 independent ones: 8 % for 1 sigma of the ratio. Beyond 40 degrees rows
        // share pixels with the line's kernels in a way that the model does not know, and count for more than
        // they are (0.2 in the worst case, 0.08 before their scale was). In grain a narrow kernel averages
        // over less of the line than an oblique row crosses (grain_centres looks 2.5 standard deviations
        // aside), and a fifth of its points are bridges, whose error grows with the gap.
        const bool steep = std::abs(slope) > 0.8;
        EXPECT_GE(actual / predicted, !steep         ? (kernel > 1.5 || contrast == 0 ? 0.55 : 0.35)
                                      : kernel > 1.5 ? 0.5
                                                     : 0.15)
            << slope << ' ' << contrast << ' ' << kernel;
        EXPECT_LE(actual / predicted, 1.35) << slope << ' ' << contrast << ' ' << kernel;
      }
}

TEST(RowScatter, ABentLineWithoutNoiseHasNone) {
  RealStripe stripe = straight(0, 1);
  stripe.centre = [](double y) { return 80 + 30 * std::sin(y / 90); };
  stripe.read_noise = 0.3;
  EXPECT_LT(std::sqrt(measured(stripe).of_point(2)), 0.01);
}

TEST(RowScatter, AFewRowsSayNothing) {
  RealStripe stripe = straight(0.3, 1);
  stripe.height = 24;
  EXPECT_EQ(measured(stripe).rows, 0);
  EXPECT_EQ(measured(stripe).of_point(2), 0);
}

}  // namespace
}  // namespace lightstripe
