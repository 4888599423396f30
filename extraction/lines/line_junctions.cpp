// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/line_junctions.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "extraction/follow/direction_guided_ridge.h"

namespace lightstripe {
namespace {

/// Bridged points [begin, end) of one line.
struct Bridge {
  std::size_t begin = 0, end = 0;
};

/// v = c0 + c1 w + c2 w^2 over w = u / length; u along the chord from side to side, v across it.
struct JunctionCurve {
  double x = 0, y = 0, along_x = 1, along_y = 0, length = 1;  ///< the chord's middle, direction, half length
  Eigen::Vector3d c = Eigen::Vector3d::Zero();
  double rms = 0, expected = 0;  ///< px: of the points it was fitted to, and their mean sigma_px

  double u_of(const StripePoint& p) const { return ((p.x - x) * along_x + (p.y - y) * along_y) / length; }
  double v_of(const StripePoint& p) const { return (p.y - y) * along_x - (p.x - x) * along_y; }
  double at(double w) const { return c[0] + w * (c[1] + w * c[2]); }
  double slope(double w) const { return (c[1] + 2 * w * c[2]) / length; }
  /// From a point across the chord to the curve.
  double off(const StripePoint& p) const { return at(u_of(p)) - v_of(p); }
};

bool is_bridged(const StripePoint& p) { return (p.flags & kStripeBridged) != 0; }

std::optional<Bridge> next_bridge(std::span<const StripePoint> line, std::size_t from) {
  Bridge b;
  for (b.begin = from; b.begin < line.size() && !is_bridged(line[b.begin]);) ++b.begin;
  for (b.end = b.begin; b.end < line.size() && is_bridged(line[b.end]);) ++b.end;
  return b.begin < line.size() ? std::optional(b) : std::nullopt;
}

/// Through `reach` points on each side, `margin` points away from the bridge; nothing where they are not all
/// measured.
std::optional<JunctionCurve> fit_curve(std::span<const StripePoint> line, const Bridge& b, std::size_t margin,
                                       std::size_t reach) {
  if (b.begin < margin + reach || b.end + margin + reach > line.size()) return std::nullopt;
  const auto left = line.subspan(b.begin - margin - reach, reach),
             right = line.subspan(b.end + margin, reach);
  JunctionCurve curve;
  const double dx = right.back().x - left.front().x, dy = right.back().y - left.front().y;
  const double length = std::hypot(dx, dy);
  curve.x = 0.5 * (right.back().x + left.front().x);
  curve.y = 0.5 * (right.back().y + left.front().y);
  curve.along_x = dx / length;
  curve.along_y = dy / length;
  curve.length = 0.5 * length;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d rhs = Eigen::Vector3d::Zero();
  for (const auto& side : {left, right})
    for (const StripePoint& p : side) {
      if (is_bridged(p)) return std::nullopt;
      const double w = curve.u_of(p);
      const Eigen::Vector3d powers(1, w, w * w);
      normal += powers * powers.transpose();
      rhs += curve.v_of(p) * powers;
      curve.expected += p.sigma_px / static_cast<double>(2 * reach);
    }
  curve.c = normal.ldlt().solve(rhs);
  for (const auto& side : {left, right})
    for (const StripePoint& p : side) {
      const double off = curve.v_of(p) - curve.at(curve.u_of(p));
      curve.rms += off * off / static_cast<double>(2 * reach);
    }
  curve.rms = std::sqrt(curve.rms);
  return curve;
}

/// A point that was not bridged before errs by `pulled` px at least: another line draws at it.
void put_on(const JunctionCurve& curve, double pulled, StripePoint& p) {
  const double slope = curve.slope(curve.u_of(p)), scale = 1 / std::hypot(1.0, slope);
  const double off = curve.off(p);
  p.x -= off * curve.along_y;
  p.y += off * curve.along_x;
  // Across the curve, on the side of the point's own normal.
  const double nx = scale * (-curve.along_y - slope * curve.along_x),
               ny = scale * (curve.along_x - slope * curve.along_y);
  const double sign = nx * p.normal_x + ny * p.normal_y < 0 ? -1.0 : 1.0;
  p.normal_x = sign * nx;
  p.normal_y = sign * ny;
  if (!is_bridged(p)) p.sigma_px = std::max(p.sigma_px, pulled);
  p.flags |= kStripeBridged;
}

bool goes_onto(const JunctionCurve& curve, const StripePoint& p) {
  return is_bridged(p) || std::abs(curve.off(p)) > 3 * p.sigma_px;
}

/// Whether the points that the curve would move by more than a pixel find there what light they had, to a
/// quarter of it: what crosses draws them along its own light, but off a bend a parabola runs in the dark.
template <class T>
bool stays_in_light(ImageView<T> image, const JunctionCurve& curve, std::span<const StripePoint> points) {
  double lost = 0, had = 0;
  for (const StripePoint& p : points) {
    const double off = curve.off(p);
    if (!goes_onto(curve, p) || std::abs(off) <= 1) continue;
    const NearestPixel from = nearest_inside(image, p.x, p.y),
                       to = nearest_inside(image, p.x - off * curve.along_y, p.y + off * curve.along_x);
    lost += static_cast<double>(image(from.x, from.y)) - static_cast<double>(image(to.x, to.y));
    had += static_cast<double>(p.intensity);
  }
  return lost <= 0.25 * had;
}

template <class T>
void mend(ImageView<T> image, std::span<StripePoint> line, const Bridge& b, double sigma) {
  constexpr double kAgrees = 2;  // times the points' own error
  const auto reach = static_cast<std::size_t>(8 * sigma);
  for (const double wanted : {2.0, 4.0, 6.0}) {
    const auto margin = static_cast<std::size_t>(wanted * sigma);
    const auto curve = fit_curve(line, b, margin, reach);
    if (!curve || curve->rms > kAgrees * curve->expected) continue;
    const auto within = line.subspan(b.begin - margin, b.end - b.begin + 2 * margin);
    if (!stays_in_light<T>(image, *curve, within)) continue;
    for (StripePoint& p : within)
      if (goes_onto(*curve, p)) put_on(*curve, 0.1 * sigma, p);
    return;
  }
}

}  // namespace

template <class T>
void mend_junctions(ImageView<T> image, const DerivativeKernels& kernels, LineSet& lines) {
  for (const LineRange& r : lines.lines) {
    const std::span<StripePoint> line(lines.points.data() + r.begin, r.size());
    for (std::size_t at = 0; at < line.size();) {
      const auto bridge = next_bridge(line, at);
      if (!bridge) break;
      mend(image, line, *bridge, kernels.sigma);
      at = bridge->end;
    }
  }
}

template void mend_junctions<std::uint8_t>(ImageView8, const DerivativeKernels&, LineSet&);
template void mend_junctions<std::uint16_t>(ImageView16, const DerivativeKernels&, LineSet&);

}  // namespace lightstripe
