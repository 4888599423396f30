// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "simulate/speckle.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightstripe {
namespace {

constexpr int kSize = 512;

Image<float> pattern(const Speckle& speckle, std::uint64_t seed = 1) {
  const Image<float> even(kSize, kSize, 1.0F);
  Image<float> out = even;
  add_speckle(even, speckle, seed, 7, out);
  return out;
}

/// Covariance of pixels `dx`, `dy` apart over the product of their means.
double correlation(const Image<float>& image, int dx, int dy) {
  double sum = 0, product = 0, count = 0;
  for (int y = 0; y + dy < image.height; ++y)
    for (int x = 0; x + dx < image.width; ++x, ++count) {
      sum += double{image(x, y)};
      product += double{image(x, y)} * double{image(x + dx, y + dy)};
    }
  const double mean = sum / count;
  return product / count / (mean * mean) - 1;
}

// Some 512^2 / (2 pi g^2) independent grains: 13 000 at g = 1.8, whose variance is known to 2 to 3 %.
TEST(Speckle, ContrastIsWhatWasAskedFor) {
  for (const double contrast : {0.15, 0.3, 0.5, 0.8, 1.0})
    for (const double grain : {0.8, 1.8}) {
      const Image<float> image = pattern({contrast, grain});
      EXPECT_NEAR(std::sqrt(correlation(image, 0, 0)) / contrast, 1, 0.05) << contrast << ' ' << grain;
      double mean = 0;
      for (const float value : image.pixels) mean += double{value} / (kSize * kSize);
      EXPECT_NEAR(mean, 1, 0.03 * contrast) << contrast << ' ' << grain;
    }
}

TEST(Speckle, CorrelationFallsAsAGaussianOfTheGrain) {
  for (const double grain : {0.8, 1.6, 3.0}) {
    const Image<float> image = pattern({0.4, grain});
    const double whole = correlation(image, 0, 0);
    for (const int d : {1, 2, 3, 5}) {
      const double expected = std::exp(-0.5 * d * d / (grain * grain));
      EXPECT_NEAR(correlation(image, d, 0) / whole, expected, 0.05) << grain << ' ' << d;
      EXPECT_NEAR(correlation(image, 0, d) / whole, expected, 0.05) << grain << ' ' << d;
    }
  }
}

TEST(Speckle, OneLookIsExponential) {
  // P(I > t) = exp(-t / mean): Goodman, Speckle Phenomena in Optics, equation 3-17.
  const Image<float> image = pattern({1.0, 1.0});
  for (const float level : {0.2F, 1.0F, 2.5F}) {
    double above = 0;
    for (const float value : image.pixels) above += value > level ? 1.0 / (kSize * kSize) : 0.0;
    EXPECT_NEAR(above, std::exp(-double{level}), 0.02) << level;
  }
}

TEST(Speckle, ASeedHasOnePatternWhereverTheLightIs) {
  const Speckle speckle{0.3, 1.2};
  const Image<float> whole = pattern(speckle);
  EXPECT_EQ(whole.pixels, pattern(speckle).pixels);
  EXPECT_NE(whole.pixels, pattern(speckle, 2).pixels);
  Image<float> spot(kSize, kSize, 0.0F);
  for (int y = 100; y < 110; ++y)
    for (int x = 200; x < 300; ++x) spot(x, y) = 1;
  Image<float> out = spot;
  add_speckle(spot, speckle, 1, 7, out);
  for (int y = 100; y < 110; ++y)
    for (int x = 200; x < 300; ++x) EXPECT_EQ(out(x, y), whole(x, y));
  EXPECT_EQ(out(10, 10), 0);
}

// Dorsch, Haeusler, Herrmann 1994: the centroid of one row of a Gaussian stripe wanders by
// C sqrt(l s) / (2 pi^(1/4)), l = sqrt(2 pi) g, as long as the grain is fine against the stripe.
TEST(Speckle, CentroidOfARowWandersByTheFormula) {
  const double s = 4, grain = 1.0, contrast = 0.3;
  Image<float> stripe(64, kSize * 8);
  for (int y = 0; y < stripe.height; ++y)
    for (int x = 0; x < stripe.width; ++x)
      stripe(x, y) = static_cast<float>(100 * std::exp(-0.5 * (x - 31.5) * (x - 31.5) / (s * s)));
  Image<float> seen = stripe;
  add_speckle(stripe, {contrast, grain}, 3, 4, seen);
  double squares = 0;
  for (int y = 0; y < seen.height; ++y) {
    double light = 0, moment = 0;
    for (int x = 0; x < seen.width; ++x) {
      light += double{seen(x, y)};
      moment += double{seen(x, y)} * (x - 31.5);
    }
    squares += moment / light * (moment / light) / seen.height;
  }
  const double l = std::sqrt(2 * M_PI) * grain;
  EXPECT_NEAR(std::sqrt(squares) / (contrast * std::sqrt(l * s) / (2 * std::pow(M_PI, 0.25))), 1, 0.08);
}

}  // namespace
}  // namespace lightstripe
