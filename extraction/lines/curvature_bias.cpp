// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/curvature_bias.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "extraction/lines/local_fit.h"

namespace lightstripe {
namespace {

constexpr std::size_t kLeastReach = 2;  // nodes to both sides
constexpr double kSure = 0.95;          // trust in a parabola from which on no longer one is asked
/// Of a point's correction: its error. The parabola sees the mean bend over 6 sigma of line, and a clipped
/// stripe is no Gaussian; measured on sine-shaped lines with kernels of 4 to 10 px.
constexpr double kCorrectionError = 0.2;
/// The parabola's noise goes with the point's own: over a reach of h sigma to both sides the correction adds
/// this over h^2 to the variance of a point (a tenth more or less for h from 2.5 to 9, by the spectrum of
/// noise that a Gaussian of sigma has smoothed).
constexpr double kParabolaNoise = 2.2;

/// The way from a smoothed node to the true line, as one parabola sees it.
struct Shift {
  double x = 0, y = 0;  ///< px
  double trust = 0;     ///< 0 to 1: how far it stands out of the noise
};

/// `sigma_px`: the node's own error, which it shares with its neighbours over `shared_px` along the line.
Shift shift_of(const LocalFit& fit, double curvature_gain, double sigma, double sigma_px, double shared_px) {
  const double half_variance = 0.5 * (sigma * sigma + 1.0 / 12);
  const double shared = std::max(1.0, shared_px / std::sqrt(fit.squared_step));
  const double error = sigma_px * curvature_gain / fit.squared_step, variance = error * error * shared;
  const double square = fit.curvature_x * fit.curvature_x + fit.curvature_y * fit.curvature_y;
  if (square <= 0) return {};
  // A bend sharper than the kernel is a corner, where the series behind the formula ends.
  const double size = half_variance * std::sqrt(square), limit = 0.25 * sigma;
  const double shift = half_variance * (size > limit ? limit / size : 1.0);
  return {-shift * fit.curvature_x, -shift * fit.curvature_y, square / (square + 9 * variance)};
}

/// Parabolas over nodes, of one reach after another.
class ShiftFinder {
 public:
  ShiftFinder(std::span<const LocalFitPoint> nodes, double sigma, double shared_px)
      : fitter_(nodes), sigma_(sigma), shared_px_(shared_px) {}

  Shift at(std::size_t n, std::size_t reach, double sigma_px) {
    if (reach != reach_) gain_ = local_fit_gains(reach_ = reach).curvature;
    return shift_of(fitter_.at(n, reach), gain_, sigma_, sigma_px, shared_px_);
  }

 private:
  LocalFitter fitter_;
  double sigma_, shared_px_, gain_ = 0;
  std::size_t reach_ = 0;
};

/// One stretch without gaps and bridges.
void correct_stretch(std::span<StripePoint> points, double sigma, double shared_px, BendWorkspace& w,
                     std::span<float> errors) {
  // The bend of a line that was smoothed over sigma changes little within one.
  const auto stride = static_cast<std::size_t>(std::max(1.0, sigma));
  const auto most = std::max<std::size_t>(
      3, static_cast<std::size_t>(std::lround((3.0 * sigma + 2) / static_cast<double>(stride))));
  w.nodes.clear();
  for (std::size_t i = 0; i < points.size(); i += stride) w.nodes.push_back({points[i].x, points[i].y});
  w.shifts.assign(w.nodes.size(), {});
  ShiftFinder near(w.nodes, sigma, shared_px), far(w.nodes, sigma, shared_px);
  for (std::size_t n = 0; n < w.nodes.size(); ++n) {
    const std::size_t room = std::min(n, w.nodes.size() - 1 - n), reach = std::min(most, room);
    if (reach < kLeastReach) continue;
    const double sigma_px = points[n * stride].sigma_px;
    const Shift s = near.at(n, reach, sigma_px);
    const double reach_in_sigma = static_cast<double>(reach * stride) / sigma;
    auto& shift = w.shifts[n];
    shift = {s.trust * s.x, s.trust * s.y, 0, s.trust * kParabolaNoise / (reach_in_sigma * reach_in_sigma)};
    // In grain a gentle bend shows over a longer stretch only.
    const bool ask = s.trust <= kSure && room > reach;
    const Shift longer = ask ? far.at(n, std::min(3 * most, room), sigma_px) : Shift{};
    const double rest = 1 - s.trust;
    shift.x += rest * longer.trust * longer.x;
    shift.y += rest * longer.trust * longer.y;
    const double left_x = s.x - longer.trust * longer.x, left_y = s.y - longer.trust * longer.y;
    shift.left = rest * std::sqrt(left_x * left_x + left_y * left_y);
  }
  // Too near the ends for a fit of their own: the bend goes on.
  for (std::size_t n = 0; n < kLeastReach && w.nodes.size() > 2 * kLeastReach; ++n) {
    w.shifts[n] = w.shifts[kLeastReach];
    w.shifts[w.nodes.size() - 1 - n] = w.shifts[w.nodes.size() - 1 - kLeastReach];
  }
  const double step = 1 / static_cast<double>(stride);
  for (std::size_t n = 0; n < w.nodes.size(); ++n) {
    const BendWorkspace::Shift a = w.shifts[n], b = w.shifts[std::min(n + 1, w.shifts.size() - 1)];
    const double dx = step * (b.x - a.x), dy = step * (b.y - a.y);
    const std::size_t first = n * stride, count = std::min(stride, points.size() - first);
    // std::hypot would take a third of this function's time to keep from overflow what is a few px.
    const auto square =
        static_cast<float>(kCorrectionError * kCorrectionError * (a.x * a.x + a.y * a.y) + a.left * a.left);
    const double noise = std::sqrt(1 + a.noise);
    for (std::size_t k = 0; k < count; ++k) {
      points[first + k].x += a.x + static_cast<double>(k) * dx;
      points[first + k].y += a.y + static_cast<double>(k) * dy;
      points[first + k].sigma_px *= noise;
      float& error = errors[first + k];
      error = std::sqrt(error * error + square);
    }
  }
}

}  // namespace

void correct_curvature_bias(const DerivativeKernels& kernels, LineSet& lines, BendWorkspace& workspace) {
  lines.systematic.resize(lines.points.size(), 0.0F);
  for (const LineRange& r : lines.lines) {
    const std::span<StripePoint> line(lines.points.data() + r.begin, r.size());
    const std::span<float> errors(lines.systematic.data() + r.begin, r.size());
    for (std::size_t begin = 0; begin < line.size();) {
      const std::size_t end = joined_end(line, begin);
      correct_stretch(line.subspan(begin, end - begin), kernels.sigma, r.shared_px, workspace,
                      errors.subspan(begin, end - begin));
      begin = end;
    }
  }
}

}  // namespace lightstripe
