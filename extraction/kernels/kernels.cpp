// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/kernels/kernels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "extraction/kernels/border_window.h"

namespace lightstripe {
namespace {

double gaussian_integral(double x, double sigma) { return 0.5 * std::erf(x / (sigma * std::numbers::sqrt2)); }
double gaussian(double x, double sigma) {
  return std::exp(-0.5 * x * x / (sigma * sigma)) / (sigma * std::sqrt(2.0 * std::numbers::pi));
}

/// The Gaussian, its integral and its slope at the edge of a pixel.
struct PixelEdge {
  double integral = 0, value = 0, slope = 0;
};
PixelEdge edge_at(double x, double sigma) {
  const double value = gaussian(x, sigma);
  return {gaussian_integral(x, sigma), value, -x / (sigma * sigma) * value};
}

struct Moments {
  double sum = 0, first = 0, second = 0;
};

Moments moments(const std::vector<double>& kernel, const std::vector<double>& u) {
  Moments m;
  for (std::size_t i = 0; i < u.size(); ++i) {
    m.sum += kernel[i];
    m.first += kernel[i] * u[i];
    m.second += kernel[i] * u[i] * u[i];
  }
  return m;
}

/// kernel += factor * other
void add(std::vector<double>& kernel, double factor, const std::vector<double>& other) {
  for (std::size_t i = 0; i < kernel.size(); ++i) kernel[i] += factor * other[i];
}
void scale(std::vector<double>& kernel, double factor) {
  for (double& k : kernel) k *= factor;
}

struct KernelTriple {
  std::vector<double> smooth, slope, curvature;
};

/// The three kernels for pixels at distances `u` from the place, as far as `reach`. Cutting them off at 3
/// sigma is made good on polynomials: constants, ramps and parabolas give exactly their own derivatives.
KernelTriple shifted_kernels(const std::vector<double>& u, double sigma, double reach) {
  KernelTriple k;
  // What one pixel ends with the next one begins with: u goes up by one, and by whole parts of it.
  PixelEdge a = edge_at(u.front() - 0.5, sigma);
  for (const double d : u) {
    // The last pixel fades, so that nothing jumps when the kernel is shifted.
    const double fade = std::clamp(reach - std::abs(d), 0.0, 1.0);
    const PixelEdge b = edge_at(d + 0.5, sigma);
    k.smooth.push_back(fade * (b.integral - a.integral));
    k.slope.push_back(fade * (a.value - b.value));
    k.curvature.push_back(fade * (b.slope - a.slope));
    a = b;
  }
  scale(k.smooth, 1.0 / moments(k.smooth, u).sum);
  add(k.slope, -moments(k.slope, u).sum, k.smooth);
  scale(k.slope, 1.0 / moments(k.slope, u).first);
  add(k.smooth, -moments(k.smooth, u).first, k.slope);
  const Moments m = moments(k.curvature, u);
  add(k.curvature, -m.sum, k.smooth);
  add(k.curvature, -moments(k.curvature, u).first, k.slope);
  scale(k.curvature, 2.0 / moments(k.curvature, u).second);
  add(k.slope, -0.5 * moments(k.slope, u).second, k.curvature);
  return k;
}

double squared_norm(const std::vector<double>& kernel) {
  double sum = 0;
  for (const double k : kernel) sum += k * k;
  return sum;
}

}  // namespace

DerivativeKernels make_derivative_kernels(double sigma) {
  LIGHTSTRIPE_CHECK(sigma >= 0.4 && sigma <= 40.0, "sigma out of range");
  DerivativeKernels kernels;
  kernels.sigma = sigma;
  kernels.radius = std::max(2, static_cast<int>(std::ceil(3.2 * sigma)));
  kernels.taps = 2 * kernels.radius + 2;
  kernels.pitch =
      (kernels.taps + DerivativeKernels::kLanes - 1) / DerivativeKernels::kLanes * DerivativeKernels::kLanes;
  kernels.weights.assign(static_cast<std::size_t>(DerivativeKernels::kPhases * 3 * kernels.pitch), 0.0F);
  std::vector<double> u(static_cast<std::size_t>(kernels.taps));
  for (int phase = 0; phase < DerivativeKernels::kPhases; ++phase) {
    for (int i = 0; i < kernels.taps; ++i)
      u[static_cast<std::size_t>(i)] = i - kernels.radius - phase * (1.0 / DerivativeKernels::kPhases);
    const KernelTriple triple = shifted_kernels(u, sigma, kernels.radius + 1.0);
    float* out = kernels.weights.data() + static_cast<std::ptrdiff_t>(phase) * 3 * kernels.pitch;
    for (const auto* kernel : {&triple.smooth, &triple.slope, &triple.curvature}) {
      for (std::size_t i = 0; i < kernel->size(); ++i) out[i] = static_cast<float>((*kernel)[i]);
      out += kernels.pitch;
    }
    if (phase != 0) continue;
    kernels.gradient_gain = std::sqrt(squared_norm(triple.slope) * squared_norm(triple.smooth));
    kernels.curvature_gain = std::sqrt(squared_norm(triple.curvature) * squared_norm(triple.smooth));
  }
  return kernels;
}

template <class T>
Derivatives evaluate_at_border(const ImageView<T>& image, PhasedPosition x, PhasedPosition y,
                               const DerivativeKernels& kernels, double tangent_x, double tangent_y,
                               std::vector<T>& border_window) {
  const int left = x.pixel - kernels.radius, top = y.pixel - kernels.radius;
  fill_border_window(image, {left, top, kernels.taps, kernels.pitch, tangent_x, tangent_y}, border_window);
  return window_derivatives(border_window.data(), kernels.pitch, kernels.phase(x.phase),
                            kernels.phase(y.phase), kernels.taps, kernels.pitch);
}

template Derivatives evaluate_at_border<std::uint8_t>(const ImageView8&, PhasedPosition, PhasedPosition,
                                                      const DerivativeKernels&, double, double,
                                                      std::vector<std::uint8_t>&);
template Derivatives evaluate_at_border<std::uint16_t>(const ImageView16&, PhasedPosition, PhasedPosition,
                                                       const DerivativeKernels&, double, double,
                                                       std::vector<std::uint16_t>&);

}  // namespace lightstripe
