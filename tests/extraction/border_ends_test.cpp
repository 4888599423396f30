// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/border_ends.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "extraction/extract_stripes.h"
#include "stripe_scenes.h"

namespace lightstripe {
namespace {

const Image8 kImage(200, 100, 0);

/// From border to border of kImage, sigma 0.02 px; `y` by x.
template <class Y>
LineSet line_over_image(Y y) {
  LineSet lines = scenes::level_line(200, 7);
  for (StripePoint& p : lines.points) p.y = y(p.x), p.sigma_px = 0.02;
  find_border_errors(kImage.view(), make_derivative_kernels(4), lines);
  return lines;
}

TEST(BorderEnds, ALineThatGoesOnAsItIsHasNoOtherError) {
  for (const double bend : {0.0, 0.002}) {
    const LineSet lines = line_over_image([bend](double x) { return 50 + 0.2 * x - bend * x * x; });
    for (const float error : lines.systematic) EXPECT_LT(error, 1e-3F);
  }
}

TEST(BorderEnds, CountsWhatIsDrawnAsideAtTheBorder) {
  // 0.5 px at the first column, nothing from the seventh on.
  const LineSet lines = line_over_image([](double x) { return 50 + 0.5 * std::max(0.0, 1 - x / 6); });
  EXPECT_NEAR(lines.systematic[0], 0.5, 0.05);
  EXPECT_NEAR(lines.systematic[3], 0.25, 0.05);
  EXPECT_EQ(lines.systematic[10], 0);
  EXPECT_EQ(lines.systematic[199], 0);
}

TEST(BorderEnds, LinesThatEndInTheImageOrAreShortAreLeftAlone) {
  LineSet lines = scenes::level_line(30, 7);
  for (StripePoint& p : lines.points) p.x += 50, p.y = 50 + (p.x < 53 ? 1.0 : 0.0), p.sigma_px = 0.02;
  find_border_errors(kImage.view(), make_derivative_kernels(4), lines);
  LineSet stub = scenes::level_line(12, 7);
  for (StripePoint& p : stub.points) p.y = 50 + (p.x < 3 ? 1.0 : 0.0), p.sigma_px = 0.02;
  find_border_errors(kImage.view(), make_derivative_kernels(4), stub);
  for (const LineSet& set : {lines, stub})
    EXPECT_TRUE(std::ranges::all_of(set.systematic, [](float error) { return error == 0; }));
}

/// Largest error and largest error over sigma of the one stripe, whose true place is `x` by y.
struct Worst {
  double error = 0, surprise = 0;
};
template <class X>
Worst worst_of(const scenes::Canvas& canvas, X x) {
  const auto found = extract_stripes(canvas.exposed(1, 0, 3).view());
  Worst worst;
  EXPECT_EQ(found.stripes.size(), 1U);
  for (const Stripe& stripe : found.stripes)
    for (const StripePoint& p : stripe.points) {
      const double error = std::abs((p.x - x(p.y)) * p.normal_x);
      worst.error = std::max(worst.error, error);
      worst.surprise = std::max(worst.surprise, error / p.sigma_px);
    }
  return worst;
}

TEST(BorderEnds, SigmaHoldsWhereAWideStripeLeavesThePictureObliquely) {
  const auto x = [](double y) { return 320 + 60 * std::sin(y / 80); };
  for (const auto& [sigma, peak] : {std::pair{6.0, 382.0}, {6.0, 1020.0}, {8.0, 140.0}}) {
    scenes::Canvas canvas(640, 480, 10);
    canvas.add(scenes::make_curve([&](double u) {
      const double y = -60 + 600 * u;
      return scenes::CurvePoint{x(y), y, peak, sigma};
    }));
    EXPECT_LT(worst_of(canvas, x).surprise, 4) << sigma << ' ' << peak;  // 7 to 9 by the inner points' sigma
  }
}

/// At the last row the light of the last point was found once more, beside it.
TEST(BorderEnds, NothingIsFoundBesideTheLastPoint) {
  for (const double slope : {0.2, 0.3, 0.4})
    for (const double x0 : {75.6, 109.57, 120.2}) {
      scenes::Canvas canvas(300, 200, 10);
      canvas.add(scenes::make_line(x0 - 60 * slope, -60, x0 + 260 * slope, 260, 150, 2));
      EXPECT_LT(worst_of(canvas, [&](double y) { return x0 + slope * y; }).error, 0.15)
          << slope << ' ' << x0;  // 0.5
    }
}

}  // namespace
}  // namespace lightstripe
