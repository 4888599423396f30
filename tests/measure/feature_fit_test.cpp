// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/feature_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

template <class F>
FeaturePoints points_of(int count, const F& at) {
  FeaturePoints out;
  for (int i = 0; i < count; ++i) out.push_back({at(i)});
  return out;
}

TEST(FitLine, AnOutlierDoesNotTurnIt) {
  FeaturePoints points = points_of(41, [](int i) { return Vector2d(0.5 * i, 2 + 0.25 * i); });
  points[30].position.y() += 3;
  const ShapeFit line = fit_line(points);
  ASSERT_TRUE(line.known());
  EXPECT_NEAR(line.along.y() / line.along.x(), 0.5, 1e-9);
  EXPECT_NEAR(line.place.y() - 0.5 * line.place.x(), 2, 1e-9);
  EXPECT_EQ(line.num_points, 40);
  EXPECT_NEAR(line.half_length_mm, 10 * std::hypot(1, 0.5), 0.2);
}

// Residuals of +-0.01 in turns: they share nothing, and the mean of 100 is known to 0.001; Tukey's weights
// and what the fit has taken up add a few percent.
TEST(FitLine, SigmaOfItsPlaceFallsWithTheRootOfThePoints) {
  const ShapeFit line =
      fit_line(points_of(100, [](int i) { return Vector2d(0.1 * i, i % 2 == 0 ? 0.01 : -0.01); }));
  EXPECT_NEAR(line.rms_mm, 0.01, 1e-4);
  EXPECT_EQ(line.correlated_points, 1);
  EXPECT_NEAR(std::sqrt(line.covariance(0, 0)), 0.001, 0.00015);
  EXPECT_NEAR(std::sqrt(line.covariance(1, 1)), 0.001 / (10 / std::sqrt(12.0)), 0.00006);  // over the spread
  EXPECT_NEAR(line.peak_to_valley_mm, 0.02 + 9.9 * 0.05 / 833.25, 1e-4);  // the line leans by -0.05 / 833.25
}

TEST(FitArc, CentreAndRadius) {
  const FeaturePoints points = points_of(30, [](int i) {
    const double a = 0.3 + 0.03 * i;
    return Vector2d(3 + 10 * std::cos(a), -4 + 10 * std::sin(a));
  });
  const ShapeFit arc = fit_arc(points);
  ASSERT_TRUE(arc.known()) << arc.reason;
  EXPECT_NEAR(arc.parameters(0), 3, 1e-6);
  EXPECT_NEAR(arc.parameters(1), -4, 1e-6);
  EXPECT_NEAR(arc.parameters(2), 10, 1e-6);
  EXPECT_EQ(fit_arc(points_of(20, [](int i) { return Vector2d(i, 2 * i); })).reason, "its points are no arc");
  EXPECT_EQ(fit_arc({points.begin(), points.begin() + 5}).reason, "too few points");
}

TEST(FitExtreme, TopOfAParabola) {
  const FeaturePoints points =
      points_of(81, [](int i) { return Vector2d(0.1 * i, 5 - 0.1 * std::pow(0.1 * i - 3.14, 2)); });
  const ShapeFit top = fit_extreme(points, 1, 2);
  ASSERT_TRUE(top.known()) << top.reason;
  EXPECT_NEAR(top.parameters(0), 3.14, 1e-6);
  EXPECT_NEAR(top.parameters(1), 5, 1e-6);
  EXPECT_FALSE(fit_extreme(points, -1, 2).known());  // the lowest point lies at the end
}

TEST(FitKnee, SplitsWhereTheLinesMeet) {
  const KneeFit knee =
      fit_knee(points_of(60, [](int i) { return Vector2d(0.5 * i, std::max(0.0, 0.5 * i - 10)); }));
  ASSERT_TRUE(knee.left.known() && knee.right.known());
  EXPECT_NEAR(knee.left.along.y(), 0, 1e-9);
  EXPECT_NEAR(knee.right.along.y(), std::sqrt(0.5), 1e-9);
}

TEST(FitEnd, IsKnownToAStepOfTheSpacing) {
  const FeaturePoints points = points_of(10, [](int i) { return Vector2d(0.3 * i, 1); });
  const ShapeFit last = fit_end(points, 1), first = fit_end(points, -1);
  EXPECT_NEAR(last.parameters(0), 2.7, 1e-12);
  EXPECT_EQ(first.parameters(0), 0);
  EXPECT_NEAR(std::sqrt(last.covariance(0, 0)), 0.3 / std::sqrt(12.0), 1e-12);
}

// Blocks of five with one error each: correlations 0.8, 0.6, 0.4, 0.2, and 1 + 2 x 2 = 5.
TEST(SharedBy, CountsTheNeighboursOfOneError) {
  Random random(8);
  std::vector<double> blocks, turns;
  for (int i = 0; i < 800; ++i) {
    blocks.push_back(i % 5 == 0 ? random.gaussian() : blocks.back());
    turns.push_back(i % 2 == 0 ? 1 : -1);
  }
  EXPECT_NEAR(shared_by(blocks), 5, 1);
  EXPECT_EQ(shared_by(turns), 1);
  EXPECT_EQ(shared_by({1, 1, 1}), 1);  // too few to tell
}

}  // namespace
}  // namespace lightstripe
