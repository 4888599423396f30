// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/kernels/kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/random.h"
#include "extraction/kernels/kernels_scan.h"
#include "extraction/kernels/kernels_window.h"

namespace lightstripe {
namespace {

template <class T>
Image<T> noise_image(int width, int height, double largest, std::uint64_t seed) {
  Image<T> image(width, height);
  Random random(seed);
  for (T& pixel : image.pixels) pixel = static_cast<T>(random.uniform(0, largest));
  return image;
}

void expect_near(const Derivatives& a, const Derivatives& b, float tolerance) {
  EXPECT_NEAR(a.value, b.value, tolerance);
  EXPECT_NEAR(a.dx, b.dx, tolerance);
  EXPECT_NEAR(a.dy, b.dy, tolerance);
  EXPECT_NEAR(a.dxx, b.dxx, tolerance);
  EXPECT_NEAR(a.dxy, b.dxy, tolerance);
  EXPECT_NEAR(a.dyy, b.dyy, tolerance);
}

// Every scale has another number of taps, so that all tails of the vectors occur; odd offsets are unaligned
// rows.
TEST(Kernels, VectorsAgreeWithTheScalarReferenceForAllTails) {
  const Image8 image8 = noise_image<std::uint8_t>(301, 211, 255, 1);
  const Image16 image16 = noise_image<std::uint16_t>(301, 211, 65535, 2);
  std::vector<std::uint8_t> border8;
  std::vector<std::uint16_t> border16;
  for (double sigma = 0.7; sigma < 12; sigma *= 1.11) {
    const DerivativeKernels kernels = make_derivative_kernels(sigma);
    const int x = 101, y = 99;
    const PhasedPosition px = to_phase(x + 0.4), py = to_phase(y + 0.7);
    const auto scalar = [&](const auto& image) {
      return window_derivatives_scalar(image.row(py.pixel - kernels.radius) + px.pixel - kernels.radius,
                                       image.width, kernels.phase(px.phase), kernels.phase(py.phase),
                                       kernels.taps, kernels.pitch);
    };
    // Single precision: 2^-24 of the grey levels' sum of magnitudes, a few operations deep.
    expect_near(evaluate_derivatives(image8.view(), px, py, kernels, 0, 0, border8), scalar(image8), 2e-3F);
    expect_near(evaluate_derivatives(image16.view(), px, py, kernels, 0, 0, border16), scalar(image16), 0.5F);
  }
}

TEST(Kernels, WeightedSumsAgreeWithTheScalarReferenceForAllTailsAndSteps) {
  const Image8 image8 = noise_image<std::uint8_t>(301, 211, 255, 4);
  const Image16 image16 = noise_image<std::uint16_t>(301, 211, 65535, 5);
  Random random(6);
  std::vector<float> weights(64);
  for (float& w : weights) w = static_cast<float>(random.uniform(-1, 1));
  for (int taps = 0; taps < 64; ++taps)
    for (const std::ptrdiff_t step : {1, 2, 301}) {
      const auto *a = image8.row(3) + 11, *last = image8.row(210);
      ASSERT_LT(a + taps * step, last);
      EXPECT_NEAR(weighted_sum(a, step, weights.data(), taps),
                  weighted_sum_scalar(a, step, weights.data(), taps), 2e-3F);
      const auto* b = image16.row(3) + 11;
      EXPECT_NEAR(weighted_sum(b, step, weights.data(), taps),
                  weighted_sum_scalar(b, step, weights.data(), taps), 0.5F);
    }
}

TEST(Kernels, AgreeWithOpenCvSepFilter) {
  const Image8 image = noise_image<std::uint8_t>(120, 90, 255, 3);
  const DerivativeKernels kernels = make_derivative_kernels(2.3);
  std::vector<cv::Mat> rows;
  for (int order = 0; order < 3; ++order) {
    rows.emplace_back(1, 2 * kernels.radius + 1, CV_32F);
    for (int i = 0; i < rows.back().cols; ++i)
      rows.back().at<float>(i) = kernels.phase(0)[order * kernels.pitch + i];
  }
  const cv::Mat grey(image.height, image.width, CV_8U, const_cast<std::uint8_t*>(image.pixels.data()));
  const auto filtered = [&](int order_x, int order_y) {
    cv::Mat out;
    cv::sepFilter2D(grey, out, CV_32F, rows[static_cast<std::size_t>(order_x)],
                    rows[static_cast<std::size_t>(order_y)], {-1, -1}, 0, cv::BORDER_REPLICATE);
    return out;
  };
  const cv::Mat dx = filtered(1, 0), dxy = filtered(1, 1), dyy = filtered(0, 2);
  std::vector<std::uint8_t> border;
  for (int y = 0; y < image.height; y += 7)
    for (int x = 0; x < image.width; x += 5) {
      const Derivatives d = evaluate_derivatives(image.view(), {x, 0}, {y, 0}, kernels, 0, 0, border);
      EXPECT_NEAR(d.dx, dx.at<float>(y, x), 1e-3);
      EXPECT_NEAR(d.dxy, dxy.at<float>(y, x), 1e-3);
      EXPECT_NEAR(d.dyy, dyy.at<float>(y, x), 1e-3);
    }
}

TEST(Kernels, DifferentiateAParabolaExactlyAtEveryPhase) {
  // r(x, y) = 4000 + 30 x + 2 x^2 - 3 x y + y^2 around the centre, whole numbers in 16 bits.
  Image16 image(81, 81);
  for (int y = 0; y < 81; ++y)
    for (int x = 0; x < 81; ++x) {
      const int u = x - 40, v = y - 40;
      image(x, y) = static_cast<std::uint16_t>(20000 + 30 * u + 2 * u * u - 3 * u * v + v * v);
    }
  std::vector<std::uint16_t> border;
  for (const double sigma : {0.8, 1.5, 3.0}) {
    const DerivativeKernels kernels = make_derivative_kernels(sigma);
    for (int phase = 0; phase < DerivativeKernels::kPhases; phase += 3) {
      const PhasedPosition p{40, phase};
      const double u = phase / 32.0;
      const Derivatives d = evaluate_derivatives(image.view(), p, p, kernels, 0, 0, border);
      EXPECT_NEAR(d.dx, 30 + 4 * u - 3 * u, 0.02);
      EXPECT_NEAR(d.dy, -3 * u + 2 * u, 0.02);
      EXPECT_NEAR(d.dxx, 4, 0.02);
      EXPECT_NEAR(d.dxy, -3, 0.02);
      EXPECT_NEAR(d.dyy, 2, 0.02);
    }
  }
}

TEST(Kernels, NoiseGainIsTheScatterOfDerivatives) {
  const DerivativeKernels kernels = make_derivative_kernels(2.0);
  const Image16 image = [] {
    Image16 out(400, 400);
    Random random(5);
    for (auto& pixel : out.pixels)
      pixel = static_cast<std::uint16_t>(std::lround(30000 + 100 * random.gaussian()));
    return out;
  }();
  std::vector<std::uint16_t> border;
  double slope = 0, curvature = 0;
  int count = 0;
  for (int y = 20; y < 380; y += 6)
    for (int x = 20; x < 370; x += 6, ++count) {
      const Derivatives d = evaluate_derivatives(image.view(), {x, 0}, {y, 0}, kernels, 0, 0, border);
      slope += d.dx * d.dx;
      curvature += d.dxx * d.dxx;
    }
  // 3540 nearly independent samples: 1 sigma of the ratio is 1.2 %.
  EXPECT_NEAR(std::sqrt(slope / count) / (100 * kernels.gradient_gain), 1.0, 0.05);
  EXPECT_NEAR(std::sqrt(curvature / count) / (100 * kernels.curvature_gain), 1.0, 0.05);
  // The integral of the squared kernel: 1 / (8 pi sigma^4).
  EXPECT_NEAR(kernels.gradient_gain, std::sqrt(1 / (8 * 3.14159265 * 16)), 0.03 * kernels.gradient_gain);
}

TEST(Kernels, BorderContinuesASlantedLine) {
  // A line at 35 degrees that leaves the image on the left.
  Image8 image(60, 60);
  const double angle = 0.61;
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 60; ++x) {
      const double d = (y - 20) * std::cos(angle) - x * std::sin(angle);
      image(x, y) = static_cast<std::uint8_t>(std::lround(200 * std::exp(-0.5 * d * d / 4)));
    }
  const DerivativeKernels kernels = make_derivative_kernels(2.0);
  std::vector<std::uint8_t> border;
  const Derivatives d =
      evaluate_derivatives(image.view(), {0, 0}, {20, 0}, kernels, std::cos(angle), std::sin(angle), border);
  const double across = -d.dx * std::sin(angle) + d.dy * std::cos(angle);
  // Repeating border pixels instead would give a slope of several grey levels per px.
  EXPECT_NEAR(across, 0, 0.3);
}

template <class T>
void check_candidates(int width, int reach) {
  const Image<T> image = noise_image<T>(width + 3, 5, 60, static_cast<std::uint64_t>(width));
  const ScanRow<T> row{image.row(2) + 1, image.row(0) + 1, image.row(4) + 1};
  const std::size_t words = static_cast<std::size_t>((width + 63) / 64);
  for (const int level : {0, 1, 30}) {
    const ScanRule<T> rule{static_cast<T>(level), 12, reach};
    std::vector<std::uint64_t> vectors(words, ~0ULL), scalar(words, ~0ULL);
    EXPECT_EQ(mark_candidates(row, width, rule, vectors.data()),
              mark_candidates_scalar(row, width, rule, scalar.data()));
    EXPECT_EQ(vectors, scalar) << "width " << width << " reach " << reach << " level " << level;
    std::vector<T> contrasts(static_cast<std::size_t>(width));
    mark_candidates(row, width, rule, vectors.data(), contrasts.data());
    EXPECT_EQ(vectors, scalar);
    for (int x = 0; x < width; ++x) {
      const auto at = static_cast<std::size_t>(x);
      if ((scalar[at / 64] >> (at % 64) & 1U) != 0) {
        EXPECT_EQ(contrasts[at], candidate_contrast(row, x, width, reach)) << x << " of " << width;
      }
    }
  }
}

TEST(KernelsScan, CandidatesAgreeWithTheScalarReferenceForAllWidths) {
  for (int width = 1; width < 200; ++width)
    for (const int reach : {2, 5, 11}) {
      check_candidates<std::uint8_t>(width, reach);
      check_candidates<std::uint16_t>(width, reach);
    }
}

TEST(KernelsScan, LargestPixelIsFoundAtEveryPlace) {
  for (std::size_t count = 1; count < 150; ++count) {
    std::vector<std::uint8_t> pixels(count, 7);
    for (std::size_t at = 0; at < count; at += 5) {
      pixels[at] = 250;
      EXPECT_EQ(largest_pixel(pixels.data(), count), 250);
      pixels[at] = 7;
    }
  }
  EXPECT_EQ(largest_pixel(static_cast<const std::uint16_t*>(nullptr), 0), 0);
}

TEST(Kernels, PhaseRoundsToTheNearest32nd) {
  EXPECT_EQ(to_phase(5.0).pixel, 5);
  EXPECT_EQ(to_phase(5.0).phase, 0);
  EXPECT_EQ(to_phase(5.99).pixel, 6);
  EXPECT_EQ(to_phase(-0.25).pixel, -1);
  EXPECT_EQ(to_phase(-0.25).phase, 24);
  EXPECT_DOUBLE_EQ(to_phase(-0.25).value(), -0.25);
}

TEST(HalveRows, AreRoundedMeansForAllTailLengths) {
  for (std::size_t count = 0; count < 150; ++count) {
    std::vector<std::uint8_t> a(2 * count + 1), b(2 * count + 1), out(count + 1, 77);
    for (std::size_t i = 0; i < a.size(); ++i) {
      a[i] = static_cast<std::uint8_t>((i * 37 + count) % 256);
      b[i] = static_cast<std::uint8_t>(255 - (i * 91) % 256);
    }
    halve_rows(a.data(), b.data(), count, out.data());
    for (std::size_t i = 0; i < count; ++i)
      ASSERT_EQ(out[i], (a[2 * i] + a[2 * i + 1] + b[2 * i] + b[2 * i + 1] + 2) / 4) << count << " " << i;
    EXPECT_EQ(out[count], 77) << "beyond the end";
  }
}

TEST(HalveRows, Hold16Bits) {
  const std::vector<std::uint16_t> a{65535, 65535, 1, 2}, b{65535, 65534, 3, 4};
  std::vector<std::uint16_t> out(2);
  halve_rows(a.data(), b.data(), 2, out.data());
  EXPECT_EQ(out[0], 65535);
  EXPECT_EQ(out[1], 3);
}

}  // namespace
}  // namespace lightstripe
