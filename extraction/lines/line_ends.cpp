// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/line_ends.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "extraction/lines/light_end.h"
#include "extraction/lines/local_fit.h"

namespace lightstripe {
namespace {

/// z of the light's end inside of which points are as good as any: an oblique cut draws them aside by less
/// than a tenth of what it does to the last one.
constexpr double kWhole = 2.2;
/// Tangent of the angle by which a stripe is cut off obliquely, 1 sigma, before the points have told it.
constexpr double kUsualCut = 1;
/// Of the shift that the cut explains: its error.
constexpr double kShiftError = 0.25;
/// Line that is looked at, in spreads of the end beyond the disturbed points.
constexpr double kNarrow = 4, kWide = 8;
/// Mean square of the misfits over the points' own: a parabola over the wide stretch that is worse is not
/// used.
constexpr double kMostMisfit = 1.5;

/// One line seen from one of its ends.
struct EndView {
  std::span<StripePoint> points;
  std::span<float> systematic;  ///< LineSet::systematic, of these points; empty: not known
  bool from_back;

  std::size_t size() const { return points.size(); }
  /// The points before `first` have an error of their own now; what fades there fades as at `first`.
  void continue_systematic(std::size_t first) const {
    if (systematic.empty()) return;
    const auto at = [&](std::size_t i) { return from_back ? systematic.size() - 1 - i : i; };
    for (std::size_t i = 0; i < first; ++i) systematic[at(i)] = first < size() ? systematic[at(first)] : 0.0F;
  }
  StripePoint& operator[](std::size_t i) const { return points[from_back ? points.size() - 1 - i : i]; }
};

/// Strengths from the end on, one in a quarter of `spread`.
std::array<double, kEndSamples> strengths_of(const EndView& end, double spread, double step) {
  std::array<double, kEndSamples> strengths{};
  for (std::size_t k = 0; k < kEndSamples; ++k) {
    const double place = static_cast<double>(k) * spread / (static_cast<double>(kEndSamplesPerSigma) * step);
    strengths.at(k) = end[std::min(static_cast<std::size_t>(std::lround(place)), end.size() - 1)].strength;
  }
  return strengths;
}

/// The end for which the strengths speak. An oblique cut makes them fall more slowly.
LightEnd find_light_end(const EndView& end, double sigma, double width, double step) {
  LightEnd light{sigma, std::clamp(width / (2 * std::numbers::sqrt3), 0.3, 1.5 * sigma)};
  const double square = light.width * light.width, share = square / (square + sigma * sigma);
  double least = std::numeric_limits<double>::infinity();
  for (const double tangent : {0.5, 1.0, 2.0}) {
    const double spread = sigma * std::sqrt(1 + tangent * tangent * share);
    const EndOfStrength fit = fit_light_end(strengths_of(end, spread, step));
    if (fit.misfit >= 0.8 * least) continue;
    least = fit.misfit;
    light.spread = spread;
    light.inside = fit.inside;
  }
  return light;
}

/// One of the points that tell how the line goes on.
struct EndPoint {
  double u = 0, across = 0;  ///< along the line from the first whole point on, in spreads; px across
  double shift = 0;          ///< px, by a cut at 45 degrees
  double scatter = 0;        ///< px, 1 sigma
};

/// The line as a parabola, and the tangent of the cut: a + b u + c u^2 + t shift.
struct EndFit {
  Eigen::Vector4d value = Eigen::Vector4d::Zero();
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
  double misfit = 0;  ///< mean square over the expected one
};

/// `shared`: points that share their noise. The second pass knows how far the shifts may be wrong.
EndFit fit_end(std::span<const EndPoint> points, double shared) {
  EndFit fit;
  for (int pass = 0; pass < 2; ++pass) {
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    normal(3, 3) = 1 / (kUsualCut * kUsualCut);
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    double squares = 0;
    for (const EndPoint& p : points) {
      const Eigen::Vector4d row(1, p.u, p.u * p.u, p.shift);
      const double wrong = kShiftError * fit.value[3] * p.shift;
      const double variance = p.scatter * p.scatter + wrong * wrong, weight = 1 / (variance * shared);
      const double rest = p.across - row.dot(fit.value);
      squares += rest * rest / variance;
      normal += weight * row * row.transpose();
      right += weight * p.across * row;
    }
    fit.misfit = squares / static_cast<double>(points.size());  // of the first pass' line, at the end
    fit.covariance = normal.inverse();
    fit.value = fit.covariance * right;
  }
  return fit;
}

double across_at(const EndFit& fit, double u) { return fit.value[0] + u * (fit.value[1] + u * fit.value[2]); }

double sigma_at(const EndFit& fit, double u) {
  const Eigen::Vector3d row(1, u, u * u);
  return std::sqrt(row.dot(fit.covariance.topLeftCorner<3, 3>() * row));
}

/// A direction in the picture, unit.
struct Direction {
  double x = 1, y = 0;
};

/// Moves the first `disturbed` points onto the line that all points together tell.
void move_points(const EndView& end, std::size_t disturbed, std::span<const EndPoint> points,
                 const LightEnd& light, double shared, Direction along) {
  const auto narrow_count =
      static_cast<std::size_t>(static_cast<double>(points.size() - disturbed) * kNarrow / kWide);
  const EndFit narrow = fit_end(points.first(disturbed + narrow_count), shared),
               wide = fit_end(points, shared);
  const EndFit& line = wide.misfit < kMostMisfit ? wide : narrow;
  const double side = end[disturbed].normal_y * along.x - end[disturbed].normal_x * along.y > 0 ? 1.0 : -1.0;
  for (std::size_t i = 0; i < disturbed; ++i) {
    StripePoint& p = end[i];
    const double u = points[i].u, by = across_at(line, u) - points[i].across;
    p.x -= by * along.y;
    p.y += by * along.x;
    const double doubt = 0.5 * (across_at(narrow, u) - across_at(wide, u));
    // The shifts of all points are wrong together, which a fit of independent errors does not know.
    const double wrong = 0.5 * kShiftError * line.value[3] * points[i].shift;
    p.sigma_px = std::hypot(sigma_at(line, u), doubt, wrong);
    const double slope = (line.value[1] + 2 * u * line.value[2]) / light.spread;
    const double scale = side / std::sqrt(1 + slope * slope);
    p.normal_x = scale * (-along.y - slope * along.x);
    p.normal_y = scale * (along.x - slope * along.y);
  }
}

bool is_joined(const EndView& end, std::size_t count) {
  const std::span<StripePoint> stretch = end.from_back ? end.points.last(count) : end.points.first(count);
  return joined_end(stretch, 0) == count;
}

/// The points of an end in the frame of its first whole point.
void collect_points(const EndView& end, std::size_t disturbed, const LightEnd& light, double step,
                    Direction along, double sigma_px, std::vector<EndPoint>& points) {
  const StripePoint& origin = end[disturbed];
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double dx = end[i].x - origin.x, dy = end[i].y - origin.y;
    const double z = light.inside + static_cast<double>(i) * step / light.spread;
    const bool near = z < kFarthestInside;
    points[i] = {(dx * along.x + dy * along.y) / light.spread, dy * along.x - dx * along.y,
                 near ? light.shift(z) : 0.0, sigma_px * (near ? LightEnd::scatter(z) : 1.0)};
  }
}

void mend_end(const EndView& end, double sigma, double shared_px, std::vector<EndPoint>& points) {
  const auto scale = static_cast<std::size_t>(std::ceil(sigma));
  if (end.size() < 3 * scale) return;
  const StripePoint& inner = end[std::min(4 * scale, end.size() - 1)];
  const double step = std::clamp(std::hypot(end[1].x - end[0].x, end[1].y - end[0].y), 0.5, 1.5);
  const LightEnd light = find_light_end(end, sigma, inner.width, step);
  if (light.inside >= kWhole) return;
  const double points_per_spread = light.spread / step;
  const auto disturbed = std::min(
      static_cast<std::size_t>(std::ceil((kWhole - light.inside) * points_per_spread)), end.size() - 1);
  const std::size_t needed = disturbed + static_cast<std::size_t>(kWide * points_per_spread) + 1;
  end.continue_systematic(disturbed);
  if (end.size() < needed || !is_joined(end, needed)) {
    // Too little of the line is known to tell how it goes on.
    for (std::size_t i = 0; i < disturbed; ++i) {
      const double z = light.inside + static_cast<double>(i) / points_per_spread;
      const double scatter = std::max(end[i].sigma_px, inner.sigma_px * LightEnd::scatter(z));
      end[i].sigma_px = std::hypot(scatter, kUsualCut * light.shift(z));
    }
    return;
  }
  const StripePoint &origin = end[disturbed], &ahead = end[disturbed + 2 * scale];
  const double dx = ahead.x - origin.x, dy = ahead.y - origin.y, length = std::max(std::hypot(dx, dy), 1e-9);
  const Direction along{dx / length, dy / length};
  points.resize(needed);
  collect_points(end, disturbed, light, step, along, inner.sigma_px, points);
  move_points(end, disturbed, points, light, std::max(1.0, shared_px / step), along);
}

}  // namespace

void mend_line_ends(const DerivativeKernels& kernels, LineSet& lines) {
  std::vector<EndPoint> points;
  for (const LineRange& r : lines.lines) {
    const std::span<StripePoint> line(lines.points.data() + r.begin, r.size());
    const std::span<float> systematic = lines.systematic.size() == lines.points.size()
                                            ? std::span(lines.systematic).subspan(r.begin, r.size())
                                            : std::span<float>{};
    mend_end({line, systematic, false}, kernels.sigma, r.shared_px, points);
    mend_end({line, systematic, true}, kernels.sigma, r.shared_px, points);
  }
}

}  // namespace lightstripe
