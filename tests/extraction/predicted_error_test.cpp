// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// sigma_px against the truth on the line, in photon noise; at its ends: line_ends_test.
#include <gtest/gtest.h>

#include <cmath>

#include "extraction/extract_stripes.h"
#include "stripe_scenes.h"

namespace lightstripe {
namespace {

struct Ratio {
  double actual = 0, predicted = 0;
  double value() const { return std::sqrt(actual / predicted); }
};

/// A gently bent line of 700 px, which no kernel's reach of it is straight.
scenes::Curve bent_line(double y, double peak, double sigma) {
  return scenes::make_curve([=](double u) {
    const double x = 40 + 720 * u;
    return scenes::CurvePoint{x, y + 15 * std::sin(x / 90), peak, sigma};
  });
}

Ratio measured(double read_noise, double shot_gain, double sigma, double peak) {
  Ratio ratio;
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    scenes::Canvas canvas(800, 120, 8);
    const scenes::Curve curve = bent_line(60.2 + 0.3 * static_cast<double>(seed), peak, sigma);
    canvas.add(curve);
    const auto r = extract_stripes(canvas.exposed(read_noise, shot_gain, seed).view());
    for (const Stripe& s : r.stripes)
      for (const StripePoint& p : s.points) {
        if ((p.flags & kStripeBridged) != 0) continue;
        const double d = scenes::distance_to({curve}, p.x, p.y);
        ratio.actual += d * d;
        ratio.predicted += p.sigma_px * p.sigma_px;
      }
  }
  return ratio;
}

TEST(PredictedError, HoldsWithReadNoiseAndWithPhotonNoise) {
  // 3 x 720 px are some 200 to 400 independent errors: 1 sigma of the ratio is 4 to 5 %.
  for (const double sigma : {1.5, 3.0})
    for (const auto& [read, shot] : {std::pair{3.0, 0.0}, {1.5, 0.2}, {4.0, 0.4}})
      for (const double peak : {60.0, 180.0}) {
        const double ratio = measured(read, shot, sigma, peak).value();
        EXPECT_GE(ratio, 0.8) << sigma << ' ' << read << ' ' << shot << ' ' << peak;
        EXPECT_LE(ratio, 1.25) << sigma << ' ' << read << ' ' << shot << ' ' << peak;
      }
}

}  // namespace
}  // namespace lightstripe
