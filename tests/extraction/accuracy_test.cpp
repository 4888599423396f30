// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// How well the direction-guided method knows the centre, against the closed formulas of docs/method.
#include <gtest/gtest.h>

#include <cmath>

#include "extraction/extract_stripes.h"
#include "extraction/follow/line_point.h"
#include "extraction/kernels/kernels.h"
#include "extraction/workspace.h"
#include "stripe_scenes.h"

namespace lightstripe {
namespace {

using scenes::Canvas;

/// A vertical stripe with 16-bit grey values, so that quantisation (1/12 of a level) is no part of the error.
Image16 fine_stripe(double x, double s, double peak, double noise, std::uint64_t seed,
                    double background = 3000) {
  Image16 image(220, 400);
  Random random(seed);
  for (int v = 0; v < image.height; ++v)
    for (int u = 0; u < image.width; ++u) {
      const double level = background + peak * std::exp(-0.5 * (u - x) * (u - x) / (s * s));
      image(u, v) =
          static_cast<std::uint16_t>(std::lround(level + (noise > 0 ? noise * random.gaussian() : 0)));
    }
  return image;
}

TEST(Accuracy, PhaseBiasBelow0p001PxForGaussianStripes) {
  for (const double s : {1.0, 1.5, 2.0, 3.0})
    for (double phase = 0; phase < 1; phase += 0.05) {
      ExtractionOptions o;
      o.sigma = s;
      const auto r = extract_stripes(fine_stripe(100 + phase, s, 40000, 0, 1).view(), o);
      ASSERT_EQ(r.stripes.size(), 1U);
      EXPECT_NEAR(r.stripes[0].points[200].x, 100 + phase, 0.001) << "s = " << s;
    }
}

TEST(Accuracy, ScatterMeetsTheClosedFormula) {
  // 0.564 noise / A for sigma = s, whatever s; 400 rows of 20 images, correlated over about 2 sqrt(pi) s
  // rows: 1 sigma of the ratio is about 2 %.
  for (const double s : {1.5, 3.0}) {
    ExtractionOptions o;
    o.sigma = s;
    double sum = 0, predicted = 0;
    int count = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const double x = 100 + 0.05 * static_cast<double>(seed);
      const auto r = extract_stripes(fine_stripe(x, s, 10000, 200, seed).view(), o);
      ASSERT_EQ(r.stripes.size(), 1U);
      for (const StripePoint& p : r.stripes[0].points) {
        if (p.y < 12 || p.y > 388) continue;
        sum += (p.x - x) * (p.x - x);
        predicted += p.sigma_px * p.sigma_px;
        ++count;
      }
    }
    const double formula = 0.564 * 200 / 10000;
    EXPECT_LE(std::sqrt(sum / count) / formula, 1.05) << "s = " << s;
    EXPECT_GE(std::sqrt(sum / count) / formula, 0.90) << "s = " << s;
    // The same against what each point says of itself.
    EXPECT_NEAR(std::sqrt(sum / predicted), 1.0, 0.08) << "s = " << s;
  }
}

TEST(Accuracy, WidthOfABarAndOfAGaussianAreBothTheFullWidth) {
  // A bar of 2w = 8 px, its edges integrated over the pixel.
  Image8 bar(100, 100);
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 100; ++x) {
      const double covered = std::clamp(std::min(x + 0.5, 54.2) - std::max(x - 0.5, 46.2), 0.0, 1.0);
      bar(x, y) = static_cast<std::uint8_t>(std::lround(10 + 150 * covered));
    }
  ExtractionOptions o;
  o.stripe_width = 8;
  const auto r = extract_stripes(bar.view(), o);
  ASSERT_EQ(r.stripes.size(), 1U);
  EXPECT_NEAR(r.stripes[0].points[50].width, 8.0, 0.3);
  EXPECT_NEAR(r.stripes[0].points[50].x, 50.2, 0.01);
}

TEST(Accuracy, EstimatedScaleIsTheStripesOwn) {
  for (const double s : {1.2, 2.0, 3.5, 5.0}) {
    Canvas canvas(400, 300, 6);
    canvas.add(scenes::make_line(40, 60, 360, 220, 140, s));
    const auto r = extract_stripes(canvas.exposed(1.5, 0.05, 2).view());
    ASSERT_EQ(r.stripes.size(), 1U) << s;
    // Width level interpolated between pixels, 1:2:1 mean at the top: within 12 %.
    EXPECT_NEAR(r.sigma / s, 1.0, 0.12) << s;
  }
}

TEST(Accuracy, BothLinesRunStraightThroughTheirCrossing) {
  // The bridge lies on a parabola through 24 points on both sides, each good to 0.01 px: 0.05 px would be
  // five times its error. A cubic from the last points before the crossing is off by 0.3 px and more.
  scenes::Canvas canvas(400, 400, 20);
  for (const double degrees : {15.0, 75.0}) {
    const double dx = 300 * std::cos(degrees * 0.0174533), dy = 300 * std::sin(degrees * 0.0174533);
    canvas.add(scenes::make_line(200.3 - dx, 199.6 - dy, 200.3 + dx, 199.6 + dy, 110, 3.0));
  }
  ExtractionOptions options;
  options.sigma = 3.0;
  const auto result = extract_stripes(canvas.exposed(2, 0.0, 5).view(), options);
  ASSERT_EQ(result.stripes.size(), 2U);
  int near = 0;
  for (const Stripe& stripe : result.stripes)
    for (const StripePoint& p : stripe.points) {
      if (std::hypot(p.x - 200.3, p.y - 199.6) > 10) continue;
      ++near;
      double nearest = 1e9;
      for (const double degrees : {15.0, 75.0})
        nearest = std::min(nearest, std::abs((p.y - 199.6) * std::cos(degrees * 0.0174533) -
                                             (p.x - 200.3) * std::sin(degrees * 0.0174533)));
      EXPECT_LT(nearest, 0.05) << p.x << " " << p.y;
    }
  EXPECT_GT(near, 30);
}

TEST(Accuracy, WorkspaceChangesNothing) {
  ExtractionWorkspace workspace;
  ExtractionResult kept;
  for (int k = 0; k < 4; ++k) {
    Canvas canvas(200 + 20 * (k % 2), 150, 6);
    canvas.add(scenes::make_line(20, 30 + 10 * k, 180, 120, 140, 2));
    const Image8 image = canvas.exposed(1.5, 0.05, 2);
    extract_stripes(image.view(), {}, workspace, kept);
    const auto fresh = extract_stripes(image.view());
    ASSERT_EQ(kept.stripes.size(), fresh.stripes.size());
    ASSERT_EQ(kept.stripes[0].points.size(), fresh.stripes[0].points.size());
    for (std::size_t i = 0; i < fresh.stripes[0].points.size(); ++i)
      EXPECT_EQ(kept.stripes[0].points[i].x, fresh.stripes[0].points[i].x);
  }
}

}  // namespace
}  // namespace lightstripe
