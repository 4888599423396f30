// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/smoothing.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "extraction/lines/local_fit.h"

namespace lightstripe {
namespace {

constexpr double kNarrowest = 6;   // reach in sigmas; below it neighbours repeat the point's own noise
constexpr int kDoublings = 4;      // 6, 12, 24 and 48 sigmas
constexpr double kMostMisfit = 3;  // mean square of some 5 independent differences: exceeded by noise in 1 %

using Estimate = SmoothingWorkspace::Estimate;

/// The parabola over 2 reach + 1 points, near the segment's ends beside the window's middle.
Estimate estimate(LocalFitter& fitter, std::size_t i, std::size_t reach, std::size_t count, double shared) {
  const std::size_t centre = std::clamp(i, reach, count - 1 - reach);
  const double offset = static_cast<double>(i) - static_cast<double>(centre);
  const LocalFit fit = fitter.at(centre, reach);
  return {fit.x + offset * (fit.slope_x + 0.5 * offset * fit.second_x),
          fit.y + offset * (fit.slope_y + 0.5 * offset * fit.second_y),
          std::min(1.0, shared * local_fit_variance(reach, offset))};
}

/// One stretch without gaps and bridges.
void smooth_segment(std::span<StripePoint> points, double sigma, SmoothingWorkspace& w) {
  const double steps = static_cast<double>(points.size() - 1);
  const double length = std::hypot(points.back().x - points.front().x, points.back().y - points.front().y);
  // Neighbouring points share their noise over 2 sqrt(pi) sigma.
  const double shared = std::max(1.0, 3.545 * sigma * steps / std::max(length, 1.0));
  w.current.clear();
  w.places.clear();
  for (const StripePoint& p : points) {
    w.current.push_back({p.x, p.y});
    w.places.push_back({p.x, p.y});
  }
  w.wider.resize(points.size());
  w.misfit.resize(points.size() + 1);
  double wanted = kNarrowest * sigma;
  for (int level = 0; level < kDoublings; ++level, wanted *= 2) {
    const std::size_t reach = std::min(static_cast<std::size_t>(wanted), (points.size() - 1) / 2);
    if (static_cast<double>(reach) < 0.75 * wanted) break;
    LocalFitter fitter(w.places);
    w.misfit[0] = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Estimate e = w.wider[i] = estimate(fitter, i, reach, points.size(), shared);
      const double across =
          (e.x - w.current[i].x) * points[i].normal_x + (e.y - w.current[i].y) * points[i].normal_y;
      const double expected = points[i].sigma_px * points[i].sigma_px *
                              std::max(w.current[i].variance - e.variance, 0.05 * w.current[i].variance);
      w.misfit[i + 1] = w.misfit[i] + across * across / expected;
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::size_t first = i > 2 * reach ? i - 2 * reach : 0,
                        end = std::min(points.size(), i + 2 * reach + 1);
      const double mean = (w.misfit[end] - w.misfit[first]) / static_cast<double>(end - first);
      const bool grows = w.current[i].growing && mean < kMostMisfit;
      if (grows && w.wider[i].variance < w.current[i].variance) w.current[i] = w.wider[i];
      w.current[i].growing = grows;
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].x = w.current[i].x;
    points[i].y = w.current[i].y;
    points[i].sigma_px *= std::sqrt(w.current[i].variance);
  }
}

}  // namespace

void smooth_along_lines(const DerivativeKernels& kernels, LineSet& lines, SmoothingWorkspace& workspace) {
  for (const LineRange& r : lines.lines) {
    const std::span<StripePoint> line(lines.points.data() + r.begin, r.size());
    for (std::size_t begin = 0; begin < line.size();) {
      const std::size_t end = joined_end(line, begin);
      if (end - begin > 2) smooth_segment(line.subspan(begin, end - begin), kernels.sigma, workspace);
      begin = end;
    }
  }
}

}  // namespace lightstripe
