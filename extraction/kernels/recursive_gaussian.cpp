// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/kernels/recursive_gaussian.h"

#include <hwy/cache_control.h>
#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace lightstripe {
namespace {

// Farneback and Westin 2006: exponents (real and imaginary part) for sigma = 1.
constexpr double kDecay[2] = {-1.3932, -1.3732};
constexpr double kTurn[2] = {0.6681, 2.0787};

using Basis = Eigen::Vector4d;

/// The four decaying oscillations at n.
Basis basis_at(double n, double sigma) {
  Basis b;
  for (int i = 0; i < 2; ++i) {
    const double size = std::exp(kDecay[i] * n / sigma), angle = kTurn[i] * n / sigma;
    b[2 * i] = size * std::cos(angle);
    b[2 * i + 1] = size * std::sin(angle);
  }
  return b;
}

/// The Gaussian's derivative averaged over the pixel at n.
double pixel_kernel(int n, double sigma, int order) {
  const auto lower = [&](double x) {
    const double g = std::exp(-0.5 * x * x / (sigma * sigma)) / (sigma * std::sqrt(2 * std::numbers::pi));
    return order == 0   ? 0.5 * std::erf(x / (sigma * std::numbers::sqrt2))
           : order == 1 ? g
                        : -x / (sigma * sigma) * g;
  };
  return lower(n + 0.5) - lower(n - 0.5);
}

/// Amplitudes of the half line n >= 0 by least squares. An antisymmetric kernel is 0 in the middle, so that
/// its two cosines have opposite amplitudes.
Basis fit_amplitudes(double sigma, int order) {
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Basis right = Basis::Zero();
  Eigen::Matrix4d free = Eigen::Matrix4d::Identity();
  if (order == 1) {
    free(2, 0) = -1;
    free(2, 2) = 0;
    normal(2, 2) = 1;
  }
  for (int n = 0; n <= static_cast<int>(std::ceil(6 * sigma)); ++n) {
    const Basis b = free.transpose() * basis_at(n, sigma);
    // The middle counts for both halves together.
    const double weight = n == 0 ? 0.5 : 1.0;
    normal += weight * b * b.transpose();
    right += weight * pixel_kernel(n, sigma, order) * b;
  }
  return free * normal.ldlt().solve(right);
}

/// Sum of n^power h(n) over all n, of the kernel with these amplitudes on its half line.
double moment(const Basis& amplitudes, double sigma, int power) {
  double sum = power == 0 ? amplitudes.dot(basis_at(0, sigma)) : 0.0;
  for (int n = 1; n <= static_cast<int>(std::ceil(20 * sigma)); ++n)
    sum += 2 * std::pow(n, power) * amplitudes.dot(basis_at(n, sigma));
  return sum;
}

Basis kernel_amplitudes(double sigma, int order) {
  Basis a = fit_amplitudes(sigma, order);
  if (order == 0) return a / moment(a, sigma, 0);
  // A convolution turns the kernel round, so that the slope's moment is -1.
  if (order == 1) return a / -moment(a, sigma, 1);
  const Basis smooth = kernel_amplitudes(sigma, 0);
  a -= moment(a, sigma, 0) * smooth;
  return a * (2 / moment(a, sigma, 2));
}

/// 1, d_1 ... d_4 of the polynomial whose roots are the four poles.
std::array<double, kRecursiveOrder + 1> denominator(double sigma) {
  std::array<double, kRecursiveOrder + 1> d{1, 0, 0, 0, 0};
  for (int i = 0; i < 2; ++i) {
    const double size = std::exp(kDecay[i] / sigma), linear = -2 * size * std::cos(kTurn[i] / sigma),
                 square = size * size;
    for (std::size_t k = kRecursiveOrder; k > 0; --k)
      d[k] += linear * d[k - 1] + (k > 1 ? square * d[k - 2] : 0.0);
  }
  return d;
}

float settled(const RecursiveWeights& w) {
  double in = 0, past = 1;
  for (std::size_t k = 0; k < kRecursiveOrder; ++k) {
    in += double{w.input[k]};
    past += double{w.past[k]};
  }
  return static_cast<float>(in / past);
}

/// Columns that are filtered together: their rows stay in the cache from the forward to the backward part.
constexpr int kStrip = 128;

/// The columns [first, first + width) of an image.
struct Strip {
  int first = 0;
  std::size_t width = 0;
};

/// Asks for the strip's part of a row that comes soon: rows lie too far apart for the processor to foresee.
void fetch_ahead(const Image<float>& image, int y, const Strip& strip) {
  constexpr std::size_t kCacheLine = 64 / sizeof(float);
  if (y < 0 || y >= image.height) return;
  for (std::size_t x = 0; x < strip.width; x += kCacheLine) hwy::Prefetch(image.row(y) + strip.first + x);
}
constexpr int kRowsAhead = 8;

void filter_forward(const Image<float>& in, const RecursiveFilter& filter, const Strip& strip,
                    Image<float>& out) {
  std::array<float, kStrip> before{};
  for (std::size_t x = 0; x < strip.width; ++x)
    before[x] = in.row(0)[strip.first + static_cast<int>(x)] * filter.settled_forward;
  for (int y = 0; y < in.height; ++y) {
    fetch_ahead(in, y + kRowsAhead, strip);
    fetch_ahead(out, y + kRowsAhead, strip);
    const auto at = [&](int k) { return in.row(std::max(y - k, 0)) + strip.first; };
    const auto past = [&](int k) -> const float* {
      return y >= k ? out.row(y - k) + strip.first : before.data();
    };
    filter_row_recursively({at(0), at(1), at(2), at(3)}, {past(1), past(2), past(3), past(4)}, filter.forward,
                           out.row(y) + strip.first, strip.width);
  }
}

/// out += sign * the backward part.
void add_backward(const Image<float>& in, const RecursiveFilter& filter, const Strip& strip,
                  Image<float>& out) {
  std::array<std::array<float, kStrip>, kRecursiveOrder + 1> ring{};
  for (auto& row : ring)
    for (std::size_t x = 0; x < strip.width; ++x)
      row[x] = in.row(in.height - 1)[strip.first + static_cast<int>(x)] * filter.settled_backward;
  for (int y = in.height - 1; y >= 0; --y) {
    fetch_ahead(in, y - kRowsAhead, strip);
    fetch_ahead(out, y - kRowsAhead, strip);
    const auto at = [&](int k) { return in.row(std::min(y + k, in.height - 1)) + strip.first; };
    const auto past = [&](int k) { return ring[static_cast<std::size_t>(y + k) % ring.size()].data(); };
    float* row = ring[static_cast<std::size_t>(y) % ring.size()].data();
    filter_row_recursively({at(1), at(2), at(3), at(4)}, {past(1), past(2), past(3), past(4)},
                           filter.backward, row, strip.width);
    float* sum = out.row(y) + strip.first;
    for (std::size_t x = 0; x < strip.width; ++x) sum[x] += filter.sign * row[x];
  }
}

}  // namespace

RecursiveFilter make_recursive_filter(double sigma, int order) {
  const Basis amplitudes = kernel_amplitudes(sigma, order);
  const auto d = denominator(sigma);
  std::array<double, kRecursiveOrder + 1> h{};
  for (std::size_t n = 0; n < h.size(); ++n) h[n] = amplitudes.dot(basis_at(static_cast<double>(n), sigma));
  RecursiveFilter f;
  f.sign = order == 1 ? -1.0F : 1.0F;
  for (std::size_t k = 0; k < kRecursiveOrder; ++k) {
    double forward = 0, backward = 0;
    for (std::size_t j = 0; j <= k; ++j) {
      forward += d[j] * h[k - j];
      backward += d[j] * h[k + 1 - j];
    }
    f.forward.input[k] = static_cast<float>(forward);
    f.backward.input[k] = static_cast<float>(backward);
    f.forward.past[k] = f.backward.past[k] = static_cast<float>(d[k + 1]);
  }
  f.settled_forward = settled(f.forward);
  f.settled_backward = settled(f.backward);
  return f;
}

void filter_columns(const Image<float>& in, const RecursiveFilter& filter, Image<float>& out) {
  out.width = in.width;
  out.height = in.height;
  out.pixels.resize(in.pixels.size());
  for (int x = 0; x < in.width; x += kStrip) {
    const Strip strip{x, static_cast<std::size_t>(std::min(kStrip, in.width - x))};
    filter_forward(in, filter, strip, out);
    add_backward(in, filter, strip, out);
  }
}

void transpose(const Image<float>& in, Image<float>& out) {
  constexpr int kBlock = 16;
  out.width = in.height;
  out.height = in.width;
  out.pixels.resize(in.pixels.size());
  for (int y0 = 0; y0 < in.height; y0 += kBlock)
    for (int x0 = 0; x0 < in.width; x0 += kBlock)
      for (int x = x0; x < std::min(x0 + kBlock, in.width); ++x)
        for (int y = y0; y < std::min(y0 + kBlock, in.height); ++y) out(y, x) = in(x, y);
}

}  // namespace lightstripe
