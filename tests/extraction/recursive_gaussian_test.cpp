// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/kernels/recursive_gaussian.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random.h"

namespace lightstripe {
namespace {

/// The filter's answer to an impulse in the middle of a column.
std::vector<double> impulse_response(double sigma, int order, int reach) {
  Image<float> column(1, 2 * reach + 401), out;
  column(0, reach + 200) = 1;
  filter_columns(column, make_recursive_filter(sigma, order), out);
  std::vector<double> response;
  for (int n = -reach; n <= reach; ++n) response.push_back(double{out(0, reach + 200 + n)});
  return response;
}

double gaussian_derivative(double x, double sigma, int order) {
  const double g = std::exp(-0.5 * x * x / (sigma * sigma)) / (sigma * std::sqrt(2 * std::numbers::pi));
  if (order == 0) return g;
  return order == 1 ? -x / (sigma * sigma) * g : (x * x / (sigma * sigma) - 1) / (sigma * sigma) * g;
}

TEST(RecursiveGaussian, ImpulseResponseIsTheGaussiansDerivative) {
  for (const double sigma : {1.5, 2.5, 4.0, 8.0})
    for (int order = 0; order < 3; ++order) {
      const int reach = static_cast<int>(5 * sigma);
      const auto response = impulse_response(sigma, order, reach);
      const double s = std::sqrt(sigma * sigma + 1.0 / 12);  // the pixel's own width comes on top
      double largest = 0, error = 0;
      for (int n = -reach; n <= reach; ++n) {
        const double expected = gaussian_derivative(n, s, order);
        largest = std::max(largest, std::abs(expected));
        error = std::max(error, std::abs(response[static_cast<std::size_t>(n + reach)] - expected));
      }
      // Farneback and Westin's four terms: below 1 % of the peak; order 2 carries the pixel integration's
      // next term.
      EXPECT_LE(error / largest, order == 2 ? 0.02 : 0.01) << "sigma " << sigma << " order " << order;
    }
}

TEST(RecursiveGaussian, MomentsAreExact) {
  for (const double sigma : {1.0, 3.0, 6.0})
    for (int order = 0; order < 3; ++order) {
      const int reach = static_cast<int>(15 * sigma);
      const auto response = impulse_response(sigma, order, reach);
      double sum = 0, first = 0, second = 0;
      for (int n = -reach; n <= reach; ++n) {
        const double h = response[static_cast<std::size_t>(n + reach)];
        sum += h;
        first += n * h;
        second += 1.0 * n * n * h;
      }
      // Single precision, summed over some 30 sigma.
      EXPECT_NEAR(sum, order == 0 ? 1 : 0, 1e-4);
      EXPECT_NEAR(first, order == 1 ? -1 : 0, 1e-3);
      if (order == 2) {
        EXPECT_NEAR(second, 2, 5e-3);
      }
    }
}

TEST(RecursiveGaussian, ConstantsStayConstantUpToTheBorder) {
  const Image<float> flat(37, 50, 80.0F);
  Image<float> out;
  filter_columns(flat, make_recursive_filter(3, 0), out);
  for (const float v : out.pixels) EXPECT_NEAR(v, 80, 0.01);
  filter_columns(flat, make_recursive_filter(3, 2), out);
  for (const float v : out.pixels) EXPECT_NEAR(v, 0, 0.01);
}

TEST(RecursiveRow, AgreesWithTheScalarReferenceForAllTails) {
  Random random(4);
  for (std::size_t count = 1; count < 70; ++count) {
    std::vector<std::vector<float>> rows(8, std::vector<float>(count + 1));
    for (auto& row : rows)
      for (float& v : row) v = static_cast<float>(random.uniform(-1, 1));
    // One element in: unaligned rows.
    const RowPointers in{&rows[0][1], &rows[1][1], &rows[2][1], &rows[3][1]},
        past{&rows[4][1], &rows[5][1], &rows[6][1], &rows[7][1]};
    const RecursiveWeights weights{{0.3F, -0.2F, 0.5F, 0.1F}, {-1.2F, 0.7F, 0.4F, -0.3F}};
    std::vector<float> fast(count), plain(count);
    filter_row_recursively(in, past, weights, fast.data(), count);
    filter_row_recursively_scalar(in, past, weights, plain.data(), count);
    for (std::size_t i = 0; i < count; ++i) EXPECT_NEAR(fast[i], plain[i], 1e-6);
  }
}

TEST(Transpose, SwapsRowsAndColumns) {
  Image<float> in(19, 35), out;
  for (std::size_t i = 0; i < in.pixels.size(); ++i) in.pixels[i] = static_cast<float>(i);
  transpose(in, out);
  ASSERT_EQ(out.width, 35);
  for (int y = 0; y < in.height; ++y)
    for (int x = 0; x < in.width; ++x) EXPECT_EQ(out(y, x), in(x, y));
}

}  // namespace
}  // namespace lightstripe
