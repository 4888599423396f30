// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/line_spots.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "extraction/extract_stripes.h"
#include "stripe_scenes.h"

namespace lightstripe {
namespace {

/// 200 points, 5 px wide; from 100 to 109 12 px.
LineSet spotted_line() {
  LineSet lines = scenes::level_line(200, 5);
  for (std::size_t i = 100; i < 110; ++i) lines.points[i].width = 12;
  lines.systematic.assign(200, 0.0F);
  return lines;
}

TEST(LineSpots, CountWhatTheyAreWiderByWhereTheyAreClipped) {
  std::vector<float> scratch;
  LineSet lines = spotted_line();
  find_spot_errors(lines, scratch);
  for (const float error : lines.systematic) EXPECT_EQ(error, 0);  // wide, but not clipped: the line is so
  lines.points[104].flags = kStripeSaturated;
  lines.systematic[105] = 1;
  find_spot_errors(lines, scratch);
  EXPECT_NEAR(lines.systematic[100], 7 / std::sqrt(12.0), 1e-5);
  EXPECT_NEAR(lines.systematic[105], std::hypot(1, 7 / std::sqrt(12.0)), 1e-5);
  EXPECT_EQ(lines.systematic[99], 0);
  EXPECT_EQ(lines.systematic[110], 0);
}

TEST(LineSpots, ALineThatIsClippedItselfHasNone) {
  std::vector<float> scratch;
  LineSet lines = spotted_line();
  for (std::size_t i = 0; i < 200; ++i) lines.points[i].flags = i % 3 == 0 ? 0 : kStripeSaturated;
  find_spot_errors(lines, scratch);
  for (const float error : lines.systematic) EXPECT_EQ(error, 0);
}

/// A reflection beside a line, where it ends: the line seems to run into it.
TEST(LineSpots, SigmaHoldsInAReflection) {
  scenes::Canvas canvas(300, 200, 8);
  const scenes::Curve curve = scenes::make_curve([](double u) {
    return scenes::CurvePoint{20 + 260 * u, 60 + 0.0012 * std::pow(std::max(0.0, 260 * u - 130), 2), 120,
                              1.6};
  });
  canvas.add(curve);
  canvas.add_blob(198, 62, 8, 7, 0, 800);
  double surprise = 0, worst = 0;
  for (const Stripe& s : extract_stripes(canvas.exposed(1.5, 0, 2).view()).stripes)
    for (const StripePoint& p : s.points) {
      if ((p.flags & kStripeBridged) != 0) continue;
      const double error = scenes::distance_to({curve}, p.x, p.y);
      worst = std::max(worst, error);
      surprise = std::max(surprise, error / p.sigma_px);
    }
  EXPECT_GT(worst, 0.3);
  EXPECT_LT(surprise, 6);
}

/// A weld bead: higher than the plate, bright and wider. What bridges it cuts it off, by up to its height:
/// then sigma_px has to know it. It was 0.2 px in each of these.
TEST(LineSpots, SigmaHoldsWhereABridgeCutsABeadOff) {
  struct Bead {
    double height, reach, light;
  };
  for (const Bead& b : {Bead{7, 28, 400}, Bead{7, 8, 400}, Bead{10, 28, 1500}, Bead{14, 8, 400}}) {
    scenes::Canvas canvas(300, 200, 8);
    const scenes::Curve curve = scenes::make_curve([&](double u) {
      const double x = 20 + 260 * u, part = std::min(1.0, std::abs(x - 150) / b.reach);
      const double bead = 0.5 + 0.5 * std::cos(part * std::numbers::pi);
      return scenes::CurvePoint{x, 100 - b.height * bead, 120 + b.light * bead, 1.6 + 0.8 * bead};
    });
    canvas.add(curve);
    const auto found = extract_stripes(canvas.exposed(1.5, 0, 2).view());
    ASSERT_FALSE(found.stripes.empty());
    for (const Stripe& s : found.stripes)
      for (const StripePoint& p : s.points)
        EXPECT_LT(scenes::distance_to({curve}, p.x, p.y), std::max(1.0, 3 * p.sigma_px))
            << b.height << " high: " << p.x << " " << p.y << " sigma " << p.sigma_px;
  }
}

TEST(LineSpots, CoarsePixelsHideTheFlanksOfClippedBars) {
  LineSet lines = scenes::level_line(10, 32);
  lines.points[4].flags = kStripeSaturated;
  find_binning_errors(16, 1, lines);
  EXPECT_TRUE(lines.systematic.empty());  // the image's own pixels
  find_binning_errors(16, 8, lines);
  EXPECT_NEAR(lines.systematic[4], 0.048, 1e-6);
  EXPECT_EQ(lines.systematic[5], 0);
  // A line that crosses the pixels: over the kernels' length each place within them is met.
  lines.systematic.clear();
  lines.points[4].normal_x = 0.6, lines.points[4].normal_y = 0.8;
  find_binning_errors(16, 8, lines);
  EXPECT_NEAR(lines.systematic[4], 0.012, 1e-6);
}

/// A clipped bar of 32 px that runs along the pixels, so that all rows share one error: up to 0.055 px at a
/// sigma of 0.002 where only their scatter told it.
TEST(LineSpots, SigmaHoldsForAnUprightClippedBar) {
  for (const double x : {190.0, 190.25, 300.0, 300.5}) {
    scenes::Canvas canvas(640, 400, 10);
    canvas.add(scenes::make_line(x, -60, x, 460, 15 * 255, 6));
    const auto found = extract_stripes(canvas.exposed(1, 0, 3).view());
    ASSERT_EQ(found.stripes.size(), 1U) << x;
    const StripePoint& middle = found.stripes[0].points[found.stripes[0].points.size() / 2];
    EXPECT_LT(std::abs(middle.x - x), 3 * middle.sigma_px) << x;
  }
}

}  // namespace
}  // namespace lightstripe
