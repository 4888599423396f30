// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Pictures of 16 bits through the extract job: what a camera of 12 bits knows is not thrown away.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "extraction/extract_stripes.h"
#include "io/images.h"
#include "io/tables.h"
#include "pipeline/extract_job.h"
#include "tests/io/temp_folder.h"

namespace lightstripe {
namespace {

double centre_at(double y) { return 40 + 0.037 * y; }

/// PNM of 12 bits without noise: a faint line of 30 levels of 256, that is 480 of 4096.
std::string faint_line() {
  constexpr int kWidth = 90, kHeight = 300;
  std::string file = "P5\n90 300\n4095\n";
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double d = x - centre_at(y);
      const auto level = static_cast<unsigned>(std::lround(100 + 480 * std::exp(-0.5 * d * d / 2.25)));
      file += static_cast<char>(level >> 8);
      file += static_cast<char>(level & 255);
    }
  return file;
}

double rms_px(const std::vector<Stripe>& stripes) {
  double squares = 0, count = 0;
  for (const Stripe& stripe : stripes)
    for (const StripePoint& p : stripe.points) {
      if (p.y < 6 || p.y > 293) continue;  // beyond the border the last row stands for all
      squares += std::pow((p.x - centre_at(p.y)) / std::hypot(1, 0.037), 2);
      count += 1;
    }
  return std::sqrt(squares / count);
}

TEST(ExtractBits, SixteenBitsReachTheCentres) {
  const TempFolder folder;
  const auto picture = folder.write("line.pgm", faint_line());
  std::vector<Stripe> seen;
  ExtractJob job;
  job.images = {picture.string()};
  job.table = folder / "stripes.csv";
  job.on_image = [&](std::size_t, const SeenImage& image) {
    EXPECT_TRUE(std::holds_alternative<Image16>(image.image));
    seen = image.result.stripes;
  };
  extract(job);
  ASSERT_EQ(seen.size(), 1U);
  // A step of 1 of 480 levels under a line of s = 1.5 px, and what is left of the phase bias: 0.001 px.
  EXPECT_LT(rms_px(seen), 0.001);
  const double reduced = rms_px(extract_stripes(read_image(picture).view()).stripes);
  EXPECT_GT(reduced, 2 * rms_px(seen)) << "the same read in 8 bits is worse, or this test says nothing";
}

}  // namespace
}  // namespace lightstripe
