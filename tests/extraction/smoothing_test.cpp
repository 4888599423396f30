// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Smoothing along a line: straight stretches become surer, bends and corners stay.
#include "extraction/lines/smoothing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "core/random.h"
#include "extraction/extract_stripes.h"
#include "simulate/real_stripe.h"

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

// The kernels' normals of a faint line scatter by some tenths, and a curve that followed them seemed to bend.
TEST(Smoothing, NormalsThatScatterBendNothing) {
  const auto straight = [](double y) { return 100 + 0.1 * y; };
  double squares = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    LineSet lines = noisy_line(straight, seed);
    Random random(seed, 3);
    for (StripePoint& p : lines.points) {
      const double angle = 0.15 * random.gaussian();
      p.normal_x = std::cos(angle);
      p.normal_y = std::sin(angle);
    }
    SmoothingWorkspace workspace;
    smooth_along_lines(lines, workspace);
    for (const StripePoint& p : lines.points) squares += std::pow(p.x - straight(p.y), 2) / (8 * 400);
  }
  EXPECT_LT(std::sqrt(squares), kSigma / 2);
}

// Half of the line is straight: there the curve looks far, and the arc does not end it.
TEST(Smoothing, AStraightStretchGainsBesideABend) {
  const auto x_at = [](double y) { return y < 200 ? 100 : 100 + 0.002 * (y - 200) * (y - 200); };
  double squares = 0, predicted = 0, bent = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    LineSet lines = noisy_line(x_at, seed);
    SmoothingWorkspace workspace;
    smooth_along_lines(lines, workspace);
    for (const StripePoint& p : lines.points) {
      const double square = std::pow(p.x - x_at(p.y), 2) / (8 * 180);
      if (p.y > 170) bent += square * 180 / 230;
      if (p.y >= 180) continue;
      squares += square;
      predicted += p.sigma_px * p.sigma_px / (8 * 180);
    }
  }
  EXPECT_LT(std::sqrt(squares), kSigma / 2);
  EXPECT_NEAR(std::sqrt(squares / predicted), 1, 0.3);
  EXPECT_LT(std::sqrt(bent), 0.8 * kSigma);
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

// As on a real picture, where a line's end was followed into a glow beside it: the curve ran on by 10 sigma.
TEST(Smoothing, AHookAtTheEndIsNotCutOff) {
  LineSet lines = noisy_line([](double y) { return 100 + 0.1 * y; }, 3);
  lines.lines[0].shared_px = 12;
  const std::size_t corner = 396;
  const StripePoint last = lines.points[corner];
  for (std::size_t i = corner + 1; i < lines.points.size(); ++i) {
    StripePoint& p = lines.points[i];
    p.x = last.x + static_cast<double>(i - corner);
    p.y = last.y + 0.2 * static_cast<double>(i - corner);
    p.normal_x = -0.2;
    p.normal_y = 0.98;
  }
  const LineSet before = lines;
  SmoothingWorkspace workspace;
  smooth_along_lines(lines, workspace);
  for (std::size_t i = 0; i < lines.points.size(); ++i) {
    const StripePoint &p = lines.points[i], &q = before.points[i];
    EXPECT_LE(std::hypot(p.x - q.x, p.y - q.y), 3.001 * q.sigma_px) << i;
  }
}

/// Whether scans' own choice gives the same points as this one.
bool scans_take(Smoothing smoothing, const Image8& image) {
  ExtractionOptions options;
  options.smoothing = smoothing;
  const auto by_scans = extract_stripes(image.view(), scan_extraction()),
             by_this = extract_stripes(image.view(), options);
  if (by_scans.stripes.size() != by_this.stripes.size() || by_this.stripes.empty()) return false;
  for (std::size_t k = 0; k < by_this.stripes.size(); ++k) {
    const auto &a = by_scans.stripes[k].points, &b = by_this.stripes[k].points;
    const auto same = [](const StripePoint& p, const StripePoint& q) {
      return p.x == q.x && p.y == q.y && p.sigma_px == q.sigma_px;
    };
    if (!std::ranges::equal(a, b, same)) return false;
  }
  return true;
}

TEST(Smoothing, ScansAreSmoothedInGrainOnly) {
  RealStripe stripe;
  const Image8 clean = picture_of(stripe, 3);
  EXPECT_TRUE(scans_take(Smoothing::kNever, clean));
  EXPECT_FALSE(scans_take(Smoothing::kAlways, clean));
  stripe.speckle = {0.3, 1.2};
  const Image8 grained = picture_of(stripe, 3);
  EXPECT_TRUE(scans_take(Smoothing::kAlways, grained));
  EXPECT_FALSE(scans_take(Smoothing::kNever, grained));
}

}  // namespace
}  // namespace lightstripe
