// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/local_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random.h"
#include "extraction/lines/smoothing.h"

namespace lightstripe {
namespace {

TEST(LocalFit, GivesAParabolaBackExactly) {
  std::vector<LocalFitPoint> points;
  for (int k = 0; k < 60; ++k) points.push_back({1000.0 + k, 500 + 0.3 * k + 0.01 * k * k});
  LocalFitter fitter(points);
  for (std::size_t i = 7; i < 53; ++i) {
    const LocalFit fit = fitter.at(i, 7);
    const auto k = static_cast<double>(i);
    EXPECT_NEAR(fit.x, 1000 + k, 1e-9);
    EXPECT_NEAR(fit.y, 500 + 0.3 * k + 0.01 * k * k, 1e-9);
    EXPECT_NEAR(fit.slope_y, 0.3 + 0.02 * k, 1e-9);
    EXPECT_NEAR(fit.second_y, 0.02, 1e-9);
    // Curvature of y(x): y'' / (1 + y'^2)^1.5.
    const double slope = 0.3 + 0.02 * k;
    EXPECT_NEAR(std::hypot(fit.curvature_x, fit.curvature_y), 0.02 / std::pow(1 + slope * slope, 1.5), 1e-9);
  }
}

TEST(LocalFit, SlidingSumsAgreeWithFreshOnes) {
  Random random(3);
  std::vector<LocalFitPoint> points;
  for (int k = 0; k < 400; ++k) points.push_back({3000 + 1.0 * k, 2000 + 5 * random.gaussian()});
  LocalFitter sliding(points);
  for (std::size_t i = 12; i < 388; i += 1 + i % 3) {
    LocalFitter fresh(points);
    const LocalFit a = sliding.at(i, 12), b = fresh.at(i, 12);
    EXPECT_NEAR(a.y, b.y, 1e-8);
    EXPECT_NEAR(a.second_y, b.second_y, 1e-9);
  }
}

TEST(LocalFit, GainsAreTheScatterOfFits) {
  Random random(6);
  const std::size_t reach = 9;
  double centre = 0, curvature = 0, beyond = 0;
  constexpr int kTrials = 4000;  // 1 sigma of a ratio: 1.1 %
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<LocalFitPoint> points;
    for (std::size_t k = 0; k <= 2 * reach; ++k)
      points.push_back({static_cast<double>(k), random.gaussian()});
    LocalFitter fitter(points);
    const LocalFit fit = fitter.at(reach, reach);
    centre += fit.y * fit.y / kTrials;
    curvature += fit.second_y * fit.second_y / kTrials;
    const double at12 = fit.y + 12 * (fit.slope_y + 6 * fit.second_y);
    beyond += at12 * at12 / kTrials;
  }
  const LocalFitGains gains = local_fit_gains(reach);
  EXPECT_NEAR(std::sqrt(centre) / gains.centre, 1, 0.05);
  EXPECT_NEAR(std::sqrt(curvature) / gains.curvature, 1, 0.05);
  EXPECT_NEAR(std::sqrt(beyond / local_fit_variance(reach, 12)), 1, 0.05);
}

/// A line y = f(x) whose errors are those of kernels of scale sigma: white noise smoothed by it.
LineSet noisy_line(double (*shape)(double), double sigma, double sigma_px, std::uint64_t seed) {
  constexpr int kPoints = 700;
  Random random(seed);
  std::vector<double> white(kPoints + 60), noise(kPoints);
  for (double& w : white) w = random.gaussian();
  double norm = 0;
  for (int k = -30; k <= 30; ++k) norm += std::exp(-k * k / (sigma * sigma));
  for (int i = 0; i < kPoints; ++i)
    for (int k = -30; k < 30; ++k)
      noise[static_cast<std::size_t>(i)] += white[static_cast<std::size_t>(i + 30 + k)] *
                                            std::exp(-0.5 * k * k / (sigma * sigma)) / std::sqrt(norm);
  LineSet lines;
  for (int i = 0; i < kPoints; ++i) {
    StripePoint p;
    const double slope = shape(i + 0.5) - shape(i - 0.5), length = std::hypot(1, slope);
    p.normal_x = -slope / length;
    p.normal_y = 1 / length;
    p.x = i;
    p.y = shape(i) + sigma_px * length * noise[static_cast<std::size_t>(i)];
    p.sigma_px = sigma_px;
    lines.points.push_back(p);
  }
  lines.lines.push_back({0, lines.points.size(), 2 * std::sqrt(std::numbers::pi) * sigma});
  return lines;
}

double rms_error(const LineSet& lines, double (*shape)(double)) {
  double sum = 0;
  for (const StripePoint& p : lines.points) sum += std::pow((p.y - shape(p.x)) * p.normal_y, 2);
  return std::sqrt(sum / static_cast<double>(lines.points.size()));
}

TEST(Smoothing, StraightLinesGetTwiceAsGood) {
  const auto straight = [](double x) { return 100 + 0.2 * x; };
  SmoothingWorkspace workspace;
  double before = 0, after = 0, predicted = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    LineSet lines = noisy_line(straight, 2.5, 0.1, seed);
    before += rms_error(lines, straight);
    smooth_along_lines(lines, workspace);
    after += rms_error(lines, straight);
    for (const StripePoint& p : lines.points)
      predicted += p.sigma_px / static_cast<double>(lines.points.size());
  }
  EXPECT_LE(after, 0.5 * before);
  EXPECT_NEAR(after / predicted, 1.0, 0.3);
}

TEST(Smoothing, CurvesAreNotBent) {
  // Waves of 8 px over 120 px: a parabola over 24 sigma would be off by several px.
  const auto wave = [](double x) { return 100 + 8 * std::sin(x / 19.0); };
  SmoothingWorkspace workspace;
  for (const double sigma_px : {0.003, 0.03, 0.1}) {
    LineSet lines = noisy_line(wave, 2.5, sigma_px, 8);
    const double before = rms_error(lines, wave);
    smooth_along_lines(lines, workspace);
    EXPECT_LE(rms_error(lines, wave), 1.02 * before) << sigma_px;
  }
}

}  // namespace
}  // namespace lightstripe
