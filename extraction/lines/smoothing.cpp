// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/smoothing.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "extraction/lines/local_fit.h"

namespace lightstripe {
namespace {

/// Reach over the length along which neighbours share their error; below it they repeat the point's own.
constexpr double kNarrowestReach = 1.7;
constexpr double kGrowth = 1.5;
constexpr int kReaches = 8;  // the widest reach is 17 times the narrowest
/// Longest bridge that a window reaches over, in those lengths.
constexpr double kLongestBridge = 6;
/// Mean square of some 5 independent differences over its expectation: exceeded by noise in 1 %.
constexpr double kMostMisfit = 3;

using Estimate = SmoothingWorkspace::Estimate;

/// The parabola over 2 reach + 1 points, near the segment's ends beside the window's middle.
Estimate estimate(LocalFitter& fitter, std::size_t i, std::size_t reach, std::size_t count, double shared) {
  const std::size_t centre = std::clamp(i, reach, count - 1 - reach);
  const double offset = static_cast<double>(i) - static_cast<double>(centre);
  const LocalFit fit = fitter.at(centre, reach);
  return {fit.x + offset * (fit.slope_x + 0.5 * offset * fit.second_x),
          fit.y + offset * (fit.slope_y + 0.5 * offset * fit.second_y),
          shared * local_fit_variance(reach, offset)};
}

/// Of the difference of two fits, the wider of which uses the narrower one's points, against a point's own.
double difference_variance(const Estimate& narrow, const Estimate& wide) {
  return std::max(narrow.variance - wide.variance, 0.05 * narrow.variance);
}

void smooth_segment(std::span<StripePoint> points, double shared_px, SmoothingWorkspace& w) {
  const double steps = static_cast<double>(points.size() - 1);
  const double length = std::hypot(points.back().x - points.front().x, points.back().y - points.front().y);
  const double shared = std::max(1.0, shared_px * steps / std::max(length, 1.0));
  w.current.clear();
  w.places.clear();
  for (const StripePoint& p : points) {
    w.current.push_back({p.x, p.y});
    w.places.push_back({p.x, p.y});
  }
  w.wider.resize(points.size());
  w.misfit.resize(points.size() + 1);
  w.telling.assign(points.size() + 1, 0);
  double wanted = kNarrowestReach * shared;
  for (int level = 0; level < kReaches; ++level, wanted *= kGrowth) {
    const std::size_t reach = std::min(static_cast<std::size_t>(wanted), (points.size() - 1) / 2);
    if (static_cast<double>(reach) < 0.75 * wanted) break;
    LocalFitter fitter(w.places);
    w.misfit[0] = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Estimate e = w.wider[i] = estimate(fitter, i, reach, points.size(), shared);
      const double across =
          (e.x - w.current[i].x) * points[i].normal_x + (e.y - w.current[i].y) * points[i].normal_y;
      const double expected = points[i].sigma_px * points[i].sigma_px * difference_variance(w.current[i], e);
      // Near the ends a narrow parabola is worse than the point: there its difference tells nothing.
      const bool tells = e.variance < w.current[i].variance;
      w.misfit[i + 1] = w.misfit[i] + (tells ? across * across / expected : 0.0);
      w.telling[i + 1] = w.telling[i] + (tells ? 1 : 0);
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::size_t first = i > 2 * reach ? i - 2 * reach : 0,
                        end = std::min(points.size(), i + 2 * reach + 1);
      const double mean = (w.misfit[end] - w.misfit[first]) / std::max(1, w.telling[end] - w.telling[first]);
      const bool grows = w.current[i].growing && mean < kMostMisfit;
      // What the differences exceed their expectation by is the line's bend.
      const double bend = std::max(0.0, mean - 1) * difference_variance(w.current[i], w.wider[i]);
      if (grows && w.wider[i].variance + bend < w.current[i].variance + w.current[i].bend) {
        w.current[i] = w.wider[i];
        w.current[i].bend = bend;
      }
      w.current[i].growing = grows;
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].x = w.current[i].x;
    points[i].y = w.current[i].y;
    points[i].sigma_px *= std::sqrt(std::min(1.0, w.current[i].variance + w.current[i].bend));
  }
}

/// The end of the stretch that begins at `begin` without gaps and long bridges. A short bridge is a curve
/// through both sides, which a parabola over them agrees with.
std::size_t stretch_end(std::span<const StripePoint> points, std::size_t begin, double longest_bridge) {
  std::size_t end = begin + 1, bridged = 0;
  for (; end < points.size(); ++end) {
    const double dx = points[end].x - points[end - 1].x, dy = points[end].y - points[end - 1].y;
    if (dx * dx + dy * dy >= 4.0) return end - bridged;
    bridged = (points[end].flags & kStripeBridged) != 0 ? bridged + 1 : 0;
    if (static_cast<double>(bridged) > longest_bridge) break;
  }
  return std::max(begin + 1, std::min(end, points.size()) - std::min(bridged, end - begin - 1));
}

}  // namespace

void smooth_along_lines(LineSet& lines, SmoothingWorkspace& workspace) {
  for (const LineRange& r : lines.lines) {
    const std::span<StripePoint> line(lines.points.data() + r.begin, r.size());
    for (std::size_t begin = 0; begin < line.size();) {
      const std::size_t end = stretch_end(line, begin, kLongestBridge * r.shared_px);
      if (end - begin > 2) smooth_segment(line.subspan(begin, end - begin), r.shared_px, workspace);
      begin = end;
    }
  }
}

}  // namespace lightstripe
