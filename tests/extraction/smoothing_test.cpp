// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Smoothing along a line: straight stretches become surer, bends and corners stay.
#include "extraction/lines/smoothing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "core/random.h"

namespace lightstripe {
namespace {

constexpr double kSigma = 0.1;  // px

constexpr double kScale = 1.5,
                 kShared = 3.5449077 * kScale;  // px: errors are white noise, smoothed by kScale

/// A line down the picture with errors as kernels of kScale leave them.
LineSet noisy_line(const std::function<double(double)>& x_at, std::uint64_t seed) {
  Random random(seed, 1);
  std::vector<double> white(420);
  for (double& w : white) w = random.gaussian();
  LineSet lines;
  for (int y = 0; y < 400; ++y) {
    double error = 0, squares = 0;
    for (int k = -8; k <= 8; ++k) {
      const double weight = std::exp(-0.5 * k * k / (kScale * kScale));
      error += weight * white[static_cast<std::size_t>(y + 10 + k)];
      squares += weight * weight;
    }
    StripePoint p;
    p.x = x_at(y) + kSigma * error / std::sqrt(squares);
    p.y = y;
    p.normal_x = 1;
    p.sigma_px = kSigma;
    lines.points.push_back(p);
  }
  lines.lines = {{0, lines.points.size(), kShared}};
  return lines;
}

struct Errors {
  double rms = 0, sigma = 0;  ///< px
};

Errors smoothed(const std::function<double(double)>& x_at) {
  Errors e;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    LineSet lines = noisy_line(x_at, seed);
    SmoothingWorkspace workspace;
    smooth_along_lines(lines, workspace);
    for (const StripePoint& p : lines.points) {
      e.rms += std::pow(p.x - x_at(p.y), 2) / (8 * 400);
      e.sigma += p.sigma_px * p.sigma_px / (8 * 400);
    }
  }
  return {std::sqrt(e.rms), std::sqrt(e.sigma)};
}

TEST(Smoothing, AStraightLineGainsAFactorOfTwoAndSigmaKnowsIt) {
  const Errors e = smoothed([](double y) { return 100 + 0.1 * y; });
  EXPECT_LT(e.rms, kSigma / 2);
  EXPECT_NEAR(e.sigma / e.rms, 1, 0.3);
}

TEST(Smoothing, AGentleBendGainsToo) {
  const Errors e = smoothed([](double y) { return 100 + 18 * std::sin(y / 80); });
  EXPECT_LT(e.rms, kSigma / 1.4);
  EXPECT_NEAR(e.sigma / e.rms, 1, 0.35);
}

TEST(Smoothing, ACornerStays) {
  LineSet lines = noisy_line([](double y) { return 100 + std::abs(y - 200); }, 3);
  SmoothingWorkspace workspace;
  smooth_along_lines(lines, workspace);
  for (const StripePoint& p : lines.points) EXPECT_NEAR(p.x, 100 + std::abs(p.y - 200), 0.6) << p.y;
}

}  // namespace
}  // namespace lightstripe
