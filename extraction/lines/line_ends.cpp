// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/line_ends.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "extraction/kernels/width_rule.h"
#include "extraction/lines/end_view.h"
#include "extraction/lines/light_end.h"
#include "extraction/lines/local_fit.h"

namespace lightstripe {
namespace {

/// z of the light's end inside of which points are as good as any: an oblique cut draws them aside by less
/// than a tenth of what it does to the last one.
constexpr double kWhole = 3;
/// Tangent of the angle by which a stripe is cut off obliquely, 1 sigma, before the points have told it.
constexpr double kUsualCut = 1;
/// Of the shift that the cut explains: its error.
constexpr double kShiftError = 0.25;
/// Line that is looked at, in sigmas of the kernels beyond the disturbed points.
constexpr double kNarrowPart = 4, kWidePart = 8;
/// z of the first point from which on no end is seen, but noise of the strengths.
constexpr double kNoEnd = 2.2;
/// Strengths agree with an end to some 2 % where neither grain nor shading spoils them.
constexpr double kStrengthError = 0.02;
/// In sigmas of the kernels: no cut draws a line farther aside than that; then it bends.
constexpr double kFarthestAside = 1.25;
/// Mean square of the misfits over the points' own: a parabola over the wide stretch that is worse is not
/// used.
constexpr double kMostEndMisfit = 1.5;

/// What fades before `first` fades as it does there: the end itself is counted otherwise. `fading`:
/// LineSet::fading of the line's points; empty: not known.
void continue_fading(const EndView& end, std::size_t first, std::span<float> fading) {
  if (fading.empty()) return;
  const float there = first < end.size() ? fading[end.index(first)] : 0.0F;
  for (std::size_t i = 0; i < std::min(first, end.size()); ++i) fading[end.index(i)] = there;
}

/// Strengths from the end on, one in a quarter of `spread`.
std::array<double, kEndSamples> strengths_of(const EndView& end, double spread, double step) {
  std::array<double, kEndSamples> strengths{};
  for (std::size_t k = 0; k < kEndSamples; ++k) {
    const double place = static_cast<double>(k) * spread / (static_cast<double>(kEndSamplesPerSpread) * step);
    strengths.at(k) = end[std::min(static_cast<std::size_t>(std::lround(place)), end.size() - 1)].strength;
  }
  return strengths;
}

using EndPoint = LineEndWorkspace::Point;

/// The line as a parabola, and the tangent of the cut: a + b u + c u^2 + t shift.
struct EndFit {
  Eigen::Vector4d value = Eigen::Vector4d::Zero();
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
  double cost = 0;    ///< squares of the misfits over what is expected of them
  double misfit = 0;  ///< the same as a mean square over a point's own scatter

  double across(double u) const { return value[0] + u * (value[1] + u * value[2]); }
  double slope(double u) const { return value[1] + 2 * u * value[2]; }
  double sigma(double u) const {
    const Eigen::Vector3d row(1, u, u * u);
    return std::sqrt(row.dot(covariance.topLeftCorner<3, 3>() * row));
  }
};

/// `shared`: points that share their noise. The second pass knows how far the shifts may be wrong.
EndFit fit_end(std::span<const EndPoint> points, double shared) {
  EndFit fit;
  for (int pass = 0; pass < 3; ++pass) {
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    normal(3, 3) = 1 / (kUsualCut * kUsualCut);
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    fit.cost = fit.value[3] * fit.value[3] * normal(3, 3);
    for (const EndPoint& p : points) {
      const Eigen::Vector4d row(1, p.u, p.u * p.u, p.shift);
      const double wrong = kShiftError * fit.value[3] * p.shift;
      const double weight = 1 / ((p.scatter * p.scatter + wrong * wrong) * shared);
      const double rest = p.across - row.dot(fit.value);
      fit.cost += weight * rest * rest;
      normal += weight * row * row.transpose();
      right += weight * p.across * row;
    }
    if (pass == 2) break;  // the cost alone was wanted
    fit.covariance = normal.inverse();
    fit.value = fit.covariance * right;
  }
  fit.misfit = fit.cost * shared / static_cast<double>(points.size());
  return fit;
}

/// A cut of one angle, and the line that it leads to.
struct Hypothesis {
  LightEnd light;
  double strength_misfit = 0;
  std::size_t disturbed = 0;  ///< points
  EndFit narrow;
  double cost = 0;
};

/// -2 log of the probability that a cut has about this tangent, where all angles are equally likely.
double surprise_of(double tangent) { return tangent < 0.75 ? 1.8 : 3.1; }

double z_of(const LightEnd& light, std::size_t i, double step) {
  return light.inside + static_cast<double>(i) * step / light.spread();
}

std::array<Hypothesis, kEndTangents.size()> ends_by_strength(const EndView& end, double sigma, double width,
                                                             double step) {
  std::array<Hypothesis, kEndTangents.size()> all;
  for (std::size_t k = 0; k < all.size(); ++k) {
    Hypothesis& h = all.at(k);
    h.light = {sigma, std::clamp(sigma_of_full_width(width), 0.3, 1.5 * sigma), kEndTangents.at(k)};
    const EndOfStrength fit = fit_light_end(h.light, strengths_of(end, h.light.spread(), step));
    h.light.inside = fit.inside;
    h.strength_misfit = fit.misfit + kEndSamples * kStrengthError * kStrengthError;
    const double length = std::max(0.0, kWhole - fit.inside) * h.light.spread() / step;
    h.disturbed = std::min(static_cast<std::size_t>(std::ceil(length)), end.size() - 1);
  }
  return all;
}

/// A direction in the picture, unit.
struct Direction {
  double x = 1, y = 0;
};

/// What the end does to each of the points, for one angle of the cut.
void set_influence(const LightEnd& light, double step, double sigma_px, std::span<EndPoint> points) {
  const EndCurves curves(light);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const EndInfluence influence = curves.at(z_of(light, i, step));
    points[i].shift = influence.shift;
    points[i].scatter = sigma_px * influence.scatter;
  }
}

/// Moves the disturbed points onto the line that all points together tell; false where no cut explains them.
bool move_points(const EndView& end, const Hypothesis& h, const EndFit& wide,
                 std::span<const EndPoint> points, Direction along) {
  const EndFit& line = wide.misfit < kMostEndMisfit ? wide : h.narrow;
  const EndPoint& last = points.front();
  const double limit = kFarthestAside * h.light.sigma;
  if (std::abs(line.across(last.u) - last.across) > limit ||
      std::abs(wide.across(last.u) - h.narrow.across(last.u)) > limit)
    return false;
  const StripePoint& whole = end[h.disturbed];
  const double side = whole.normal_y * along.x - whole.normal_x * along.y > 0 ? 1.0 : -1.0;
  for (std::size_t i = 0; i < h.disturbed; ++i) {
    StripePoint& p = end[i];
    const double u = points[i].u, by = line.across(u) - points[i].across;
    p.x -= by * along.y;
    p.y += by * along.x;
    const double doubt = 0.5 * (wide.across(u) - h.narrow.across(u));
    // The shifts of all points are wrong together, which a fit of independent errors does not know.
    const double wrong = 0.5 * kShiftError * line.value[3] * points[i].shift;
    p.sigma_px = std::hypot(line.sigma(u), doubt, wrong);
    const double slope = line.slope(u) / h.light.sigma, scale = side / std::sqrt(1 + slope * slope);
    p.normal_x = scale * (-along.y - slope * along.x);
    p.normal_y = scale * (along.x - slope * along.y);
  }
  return true;
}

/// Too little of the line is known to tell how it goes on.
void widen_errors(const EndView& end, const Hypothesis& h, double sigma_px, double step) {
  const EndCurves curves(h.light);
  for (std::size_t i = 0; i < h.disturbed; ++i) {
    const EndInfluence influence = curves.at(z_of(h.light, i, step));
    const double scatter = std::max(end[i].sigma_px, sigma_px * influence.scatter);
    end[i].sigma_px = std::hypot(scatter, kUsualCut * influence.shift);
  }
}

void mend_end(const EndView& end, std::span<float> fading, double sigma, double shared_px,
              EndsOnPrint on_print, std::vector<EndPoint>& points) {
  const auto scale = static_cast<std::size_t>(std::ceil(sigma));
  if (end.size() < 3 * scale) return;  // three or more points, since scale is 1 at least
  const StripePoint& inner = end[std::min(4 * scale, end.size() - 1)];
  const double step = std::clamp(std::hypot(end[1].x - end[0].x, end[1].y - end[0].y), 0.5, 1.5);
  auto all = ends_by_strength(end, sigma, inner.width, step);
  const Hypothesis& likeliest = *std::ranges::min_element(all, {}, &Hypothesis::strength_misfit);
  if (likeliest.light.inside >= kNoEnd) return;
  const std::size_t reach = std::ranges::max(all, {}, &Hypothesis::disturbed).disturbed;
  continue_fading(end, reach + scale, fading);  // where fading was looked at over undisturbed points
  const auto narrow_count = reach + static_cast<std::size_t>(kNarrowPart * sigma / step),
             count = reach + static_cast<std::size_t>(kWidePart * sigma / step);
  if (on_print == EndsOnPrint::kYes || end.size() <= count || joined_end(end.stretch(count), 0) < count)
    return widen_errors(end, likeliest, inner.sigma_px, step);

  const StripePoint &origin = end[reach], &ahead = end[std::min(reach + 2 * scale, count)];
  const double dx = ahead.x - origin.x, dy = ahead.y - origin.y, length = std::max(std::hypot(dx, dy), 1e-9);
  const Direction along{dx / length, dy / length};
  points.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double x = end[i].x - origin.x, y = end[i].y - origin.y;
    points[i] = {(x * along.x + y * along.y) / sigma, y * along.x - x * along.y, 0, 0};
  }
  const double shared = std::max(1.0, shared_px / step);
  for (Hypothesis& h : all) {
    const auto first = std::span(points).first(narrow_count);
    set_influence(h.light, step, inner.sigma_px, first);
    h.narrow = fit_end(first, shared);
    // Three or four of the strengths are independent of each other.
    h.cost = h.narrow.cost + 4 * std::log(h.strength_misfit) + surprise_of(h.light.tangent);
  }
  const Hypothesis& best = *std::ranges::min_element(all, {}, &Hypothesis::cost);
  set_influence(best.light, step, inner.sigma_px, points);
  if (!move_points(end, best, fit_end(points, shared), points, along))
    widen_errors(end, likeliest, inner.sigma_px, step);
}

}  // namespace

void mend_line_ends(const DerivativeKernels& kernels, EndsOnPrint on_print, LineSet& lines,
                    LineEndWorkspace& workspace) {
  for (const LineRange& r : lines.lines) {
    const std::span<StripePoint> line(lines.points.data() + r.begin, r.size());
    const std::span<float> fading = lines.fading.size() == lines.points.size()
                                        ? std::span(lines.fading).subspan(r.begin, r.size())
                                        : std::span<float>{};
    for (const bool from_back : {false, true})
      mend_end({line, from_back}, fading, kernels.sigma, r.shared_px, on_print, workspace.points);
  }
}

}  // namespace lightstripe
