// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/image/thresholds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/random.h"
#include "extraction/image/noise.h"

namespace lightstripe {
namespace {

Histogram histogram_of(std::initializer_list<std::pair<int, std::uint32_t>> bins) {
  Histogram h;
  for (const auto& [bin, count] : bins) {
    h.counts[static_cast<std::size_t>(bin)] = count;
    h.total += count;
    h.largest = std::max<double>(h.largest, bin);
  }
  return h;
}

Image8 two_level_image(std::uint64_t seed) {
  Image8 image(200, 150);
  Random random(seed);
  for (auto& pixel : image.pixels) {
    const double level = random.uniform() < 0.2 ? 150 : 40;
    pixel = static_cast<std::uint8_t>(std::clamp(level + 15 * random.gaussian(), 0.0, 255.0));
  }
  return image;
}

TEST(Histogram, CountsEveryPixelOnceAndFindsTheBrightest) {
  Image8 image(7, 3, 10);
  image(6, 2) = 200;
  const Histogram h = compute_histogram(image.view());
  EXPECT_EQ(h.counts[10], 20U);
  EXPECT_EQ(h.counts[200], 1U);
  EXPECT_EQ(h.total, 21U);
  EXPECT_EQ(h.largest, 200);
  // A subsample may miss the pixel, the brightest level may not.
  EXPECT_EQ(compute_histogram(image.view(), 3).largest, 200);
  EXPECT_EQ(compute_histogram(image.view(), 3).total, 7U);
}

TEST(Histogram, SixteenBitLevelsShareBins) {
  Image16 image(4, 1);
  image(3, 0) = 1023;
  const Histogram h = compute_histogram(image.view());
  EXPECT_EQ(h.bin_width, 4);
  EXPECT_EQ(h.counts[255], 1U);
}

TEST(Otsu, AgreesWithOpenCv) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Image8 image = two_level_image(seed);
    cv::Mat grey(image.height, image.width, CV_8U, const_cast<std::uint8_t*>(image.pixels.data())), binary;
    const double expected = cv::threshold(grey, binary, 0, 255, cv::THRESH_BINARY | cv::THRESH_OTSU);
    EXPECT_EQ(otsu_threshold(compute_histogram(image.view())), static_cast<int>(expected));
  }
}

TEST(Rosin, FindsTheCornerOfAHandMadeHistogram) {
  // Line from (10, 1000) to (110, 0): at bin 14 it stands at 960, the histogram at 20: 940 below, more than
  // anywhere.
  const Histogram h =
      histogram_of({{10, 1000}, {11, 600}, {12, 250}, {13, 90}, {14, 20}, {15, 18}, {110, 0}, {109, 9}});
  EXPECT_EQ(rosin_threshold(h), 14);
}

TEST(Rosin, PeakAtTheBrightEndIsItsOwnCorner) {
  EXPECT_EQ(rosin_threshold(histogram_of({{3, 5}, {200, 50}})), 200);
}

TEST(Entropy, OfEqualLevelsIsTheLogOfTheirNumber) {
  EXPECT_DOUBLE_EQ(histogram_entropy(histogram_of({{1, 5}, {9, 5}, {70, 5}, {200, 5}})), 2.0);
  EXPECT_DOUBLE_EQ(histogram_entropy(histogram_of({{1, 5}})), 0.0);
}

TEST(HistogramPeaks, AreCountedOnceEach) {
  Histogram h;
  for (const int centre : {20, 90, 180})
    for (int d = -10; d <= 10; ++d)
      h.counts[static_cast<std::size_t>(centre + d)] +=
          static_cast<std::uint32_t>(1000 * std::exp(-d * d / 20.0));
  for (const auto c : h.counts) h.total += c;
  EXPECT_EQ(count_histogram_peaks(h), 3);
}

TEST(BilevelThresholds, FollowThePapersFormula) {
  // The paper's reflecting wheel: (T_min, T_rosin, T_otsu) = (5, 25, 97) and alpha 0.75 give T_l = 10.
  BilevelThresholds t;
  Histogram h = histogram_of({{5, 4000}, {6, 900}, {60, 30}, {200, 60}});
  ThresholdOptions options;
  options.alpha = 0.75;
  options.beta = 0.5;
  t = compute_bilevel_thresholds(h, options);
  EXPECT_EQ(t.t_min, 5);
  EXPECT_EQ(t.t_max, 200);
  EXPECT_DOUBLE_EQ(t.low, 0.75 * t.t_min + 0.25 * std::min(t.t_rosin, t.t_otsu));
  EXPECT_DOUBLE_EQ(t.high, 0.5 * t.t_max + 0.5 * std::max(t.t_rosin, t.t_otsu));
  options.alpha = 0.0;
  options.beta = 0.0;
  t = compute_bilevel_thresholds(h, options);
  EXPECT_DOUBLE_EQ(t.low, std::min(t.t_rosin, t.t_otsu));
}

TEST(BilevelThresholds, DisturbingLightRaisesAlphaByItself) {
  Histogram quiet, disturbed;
  for (int bin = 0; bin < 200; ++bin) {
    const double background = 40000 * std::exp(-0.5 * std::pow((bin - 6) / 2.0, 2));
    const double spots = 4000 * (std::exp(-0.5 * std::pow((bin - 70) / 12.0, 2)) +
                                 std::exp(-0.5 * std::pow((bin - 150) / 12.0, 2)));
    quiet.counts[static_cast<std::size_t>(bin)] = static_cast<std::uint32_t>(background + 3);
    disturbed.counts[static_cast<std::size_t>(bin)] = static_cast<std::uint32_t>(background + spots);
  }
  for (Histogram* h : {&quiet, &disturbed})
    for (const auto c : h->counts) h->total += c;
  EXPECT_EQ(compute_bilevel_thresholds(quiet).alpha, 0.0);
  EXPECT_EQ(compute_bilevel_thresholds(disturbed).alpha, 0.75);
}

TEST(Noise, IsMeasuredWithinFivePercent) {
  for (const double sigma : {0.8, 1.5, 4.0, 12.0}) {
    Image8 image(400, 300);
    Random random(8);
    for (int y = 0; y < 300; ++y)
      for (int x = 0; x < 400; ++x)
        image(x, y) = static_cast<std::uint8_t>(std::lround(60 + 0.2 * x + sigma * random.gaussian()));
    // Quantisation adds 1/12 to the variance; 60 000 samples of a median: below 1 %.
    EXPECT_NEAR(estimate_noise(image.view()).full / std::sqrt(sigma * sigma + 1.0 / 12), 1.0, 0.05);
  }
}

TEST(Noise, OfAClippedBackgroundIsMadeUpFor) {
  Image8 image(400, 300);
  Random random(9);
  for (auto& pixel : image.pixels)
    pixel = static_cast<std::uint8_t>(std::max(0L, std::lround(4.0 * random.gaussian())));
  EXPECT_NEAR(estimate_noise(image.view()).full, 4.0, 1.0);
}

}  // namespace
}  // namespace lightstripe
