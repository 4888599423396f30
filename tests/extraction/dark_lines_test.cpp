// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// polarity: dark. A rendered dark line of known centre is found as exactly as a bright one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "extraction/extract_stripes.h"

namespace lightstripe {
namespace {

double centre(int y) { return 100.3 + 20 * std::sin(y / 90.0); }

/// A line that takes `depth` grey levels from a surface of grey level `paper`; negative: it adds them.
template <class T>
Image<T> picture(double paper, double depth, double noise) {
  Random random(11, 3);
  Image<T> image(200, 300);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double slope = 20.0 / 90 * std::cos(y / 90.0);
      const double d = (x - centre(y)) / std::sqrt(1 + slope * slope);
      const double grey = paper - depth * std::exp(-0.5 * d * d / 4) + noise * random.gaussian();
      image(x, y) =
          static_cast<T>(std::clamp(std::lround(grey), 0L, static_cast<long>(std::numeric_limits<T>::max())));
    }
  return image;
}

struct Found {
  std::size_t lines = 0;
  double rows = 0, rms = 0;
};

template <class T>
Found found_in(const Image<T>& image, const ExtractionOptions& options) {
  Found found;
  for (const Stripe& stripe : extract_stripes(image.view(), options).stripes) {
    ++found.lines;
    for (const StripePoint& p : stripe.points) {
      const double slope = 20.0 / 90 * std::cos(p.y / 90.0);
      const double error = (p.x - 100.3 - 20 * std::sin(p.y / 90.0)) / std::sqrt(1 + slope * slope);
      found.rows += 1;
      found.rms += error * error;
    }
  }
  found.rms = std::sqrt(found.rms / std::max(1.0, found.rows));
  return found;
}

TEST(DarkLines, AreFoundAsExactlyAsBrightOnesByEveryMethod) {
  for (const auto& [method, name] : enum_names(ExtractionMethod{})) {
    ExtractionOptions bright, dark;
    bright.method = dark.method = method;
    dark.polarity = Polarity::kDark;
    const Found a = found_in(picture<std::uint8_t>(60, -120, 2), bright),
                b = found_in(picture<std::uint8_t>(195, 120, 2), dark);
    EXPECT_EQ(b.lines, 1U) << name;
    EXPECT_GT(b.rows, 294) << name;
    EXPECT_LT(b.rms, 1.2 * a.rms + 0.003) << name;
    EXPECT_LT(b.rms, 0.08) << name;
  }
}

TEST(DarkLines, AreNotLookedForByDefaultNorBrightOnesWithPolarityDark) {
  ExtractionOptions dark;
  dark.polarity = Polarity::kDark;
  EXPECT_EQ(found_in(picture<std::uint8_t>(195, 120, 2), {}).lines, 0U);
  EXPECT_EQ(found_in(picture<std::uint8_t>(60, -120, 2), dark).lines, 0U);
}

TEST(DarkLines, OfTwelveBitsKeepTheirBits) {
  ExtractionOptions dark;
  dark.polarity = Polarity::kDark;
  const Found found = found_in(picture<std::uint16_t>(3000, 1900, 32), dark);
  EXPECT_EQ(found.lines, 1U);
  EXPECT_GT(found.rows, 294);
  EXPECT_LT(found.rms, 0.02);
}

}  // namespace
}  // namespace lightstripe
