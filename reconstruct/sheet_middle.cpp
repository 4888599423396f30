// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/sheet_middle.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/robust.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// px^2: what a soft lens (0.75 px) and the pixels (0.29 px) add to the line's variance. A sharper lens
/// leaves a part of the shift undone; less here, and a thin sheet behind a soft lens would be taken for a
/// thick one (a ball under a sheet of 0.2 mm came out 0.03 mm larger).
constexpr double kBlur = 0.64;
constexpr double kLeastAcross = 0.4;  // d.n: below it the width tells little of the sheet
constexpr std::size_t kFewestWidths = 8;
/// Of s: farther than that the series behind the formula ends.
constexpr double kLargestShift = 0.3;
/// Widths from a line's end on: where the kernels begin to see it, and do no longer.
constexpr double kEndBegins = 0.9, kEndIsOver = 1.8;
/// Points between two places at which the plane's normal is projected: its direction turns by some degrees
/// over a picture.
constexpr std::size_t kProjected = 16;
/// Of StripePoint::fade_px (1 sigma): what the oblique border of a stain may still do once the sheet's part
/// is undone.
constexpr double kLeftOfFade = 0.5;

bool is_measured(const StripePoint& p) {
  return (p.flags & (kStripeBridged | kStripeSaturated)) == 0 && p.strength > 0;
}

/// The plane's normal as the picture shows it at a place on the plane, of unit length.
Vector2d direction_at(const Camera& camera, const Plane& plane, const StripePoint& p) {
  const auto ray = unproject(camera, {p.x, p.y});
  const auto place = ray ? intersect(plane, Vector3d::Zero(), *ray) : std::nullopt;
  if (!place) return Vector2d::Zero();
  const Vector3d step = 1e-4 * place->z() * plane.normal;
  const auto ahead = project(camera, *place + step), behind = project(camera, *place - step);
  if (!ahead || !behind) return Vector2d::Zero();
  const Vector2d seen = *ahead - *behind;
  const double length = seen.norm();
  return length > 0 ? Vector2d(seen / length) : Vector2d(Vector2d::Zero());
}

Vector2d place_of(const StripePoint& p) { return {p.x, p.y}; }

/// The line around one of its points, from the first to the last of these.
struct Stretch {
  std::size_t first = 0, last = 0;
  Vector2d tangent = Vector2d::UnitX(), normal = Vector2d::UnitY();
  double length = 0;  ///< px
};

/// From `reach` points before to as many behind, fewer at the ends; a length of 0 where it has a gap.
Stretch stretch_at(std::span<const StripePoint> line, std::size_t i, std::size_t reach) {
  const std::size_t first = i - std::min(i, reach), last = std::min(i + reach, line.size() - 1);
  const Vector2d chord = place_of(line[last]) - place_of(line[first]);
  const double length = chord.norm();
  // Neighbours lie at most a pixel's diagonal apart.
  if (!(length > 0) || length > 1.5 * static_cast<double>(last - first)) return {};
  const Vector2d tangent = chord / length, across(tangent.y(), -tangent.x());
  const double side = across.dot(Vector2d(line[i].normal_x, line[i].normal_y)) < 0 ? -1 : 1;
  return {first, last, tangent, side * across, length};
}

/// By the two halves of a stretch, 1 / px.
Vector2d curvature_at(std::span<const StripePoint> line, std::size_t i, std::size_t reach) {
  const std::size_t middle = std::clamp(i, reach, line.size() - 1 - reach);
  const Vector2d before = place_of(line[middle]) - place_of(line[middle - reach]),
                 behind = place_of(line[middle + reach]) - place_of(line[middle]);
  const double a = before.norm(), b = behind.norm();
  if (!(a > 0 && b > 0)) return Vector2d::Zero();
  return 2 * (behind / b - before / a) / (a + b);
}

/// One line, and what is known along it.
struct SeenSheet {
  std::span<const StripePoint> line;
  std::size_t reach = 3;             ///< points: about a width
  std::vector<Vector2d> directions;  ///< of the plane's normal, every kProjected points and at the last
  std::vector<double> brightness;    ///< logarithm of the strength
  double grain = 0;                  ///< variance of what two places `reach` to both sides differ by

  Vector2d direction(std::size_t i) const {
    const std::size_t k = i / kProjected, begin = k * kProjected;
    const std::size_t end = std::min(begin + kProjected, line.size() - 1);
    if (end == begin) return directions[k];
    const double share = static_cast<double>(i - begin) / static_cast<double>(end - begin);
    return (1 - share) * directions[k] + share * directions[k + 1];
  }
  /// How the brightness changes over the stretch around a point, less what may be grain (James and Stein).
  double change(std::size_t first, std::size_t last) const {
    const double seen = brightness[last] - brightness[first];
    return seen * seen > grain ? seen - grain / seen : 0;
  }
};

/// px^2 along the plane's normal; 0 where the line does not tell.
double sheet_variance(const SeenSheet& seen, std::vector<double>& scratch) {
  scratch.clear();
  for (std::size_t i = seen.reach; i + seen.reach < seen.line.size(); i += 4) {
    const StripePoint& p = seen.line[i];
    const double across = seen.direction(i).dot(Vector2d(p.normal_x, p.normal_y));
    if (!is_measured(p) || std::abs(across) < kLeastAcross) continue;
    scratch.push_back(std::max(0.0, p.width * p.width / 12 - kBlur) / (across * across));
  }
  return scratch.size() < kFewestWidths ? 0 : upper_median(scratch);
}

/// By second differences, in which shading cancels: of independent values they have three times the variance
/// of a difference.
double grain_of(const SeenSheet& seen, std::vector<double>& scratch) {
  scratch.clear();
  const std::size_t step = 2 * seen.reach;
  for (std::size_t i = step; i + step < seen.line.size(); i += 2)
    scratch.push_back(
        std::abs(seen.brightness[i - step] - 2 * seen.brightness[i] + seen.brightness[i + step]));
  if (scratch.size() < kFewestWidths) return 0;
  const double scatter = kMadToSigma * upper_median(scratch);
  return scatter * scatter / 3;
}

SheetShift shift_at(const SeenSheet& seen, std::size_t i, double variance) {
  const auto from_end = static_cast<double>(std::min(i, seen.line.size() - 1 - i));
  const auto width = static_cast<double>(seen.reach);
  const double whole = std::clamp((from_end / width - kEndBegins) / (kEndIsOver - kEndBegins), 0.0, 1.0);
  if (whole == 0) return {};
  const Stretch stretch = stretch_at(seen.line, i, seen.reach);
  if (!(stretch.length > 0) || !is_measured(seen.line[stretch.first]) || !is_measured(seen.line[i]) ||
      !is_measured(seen.line[stretch.last]))
    return {};
  const Vector2d direction = seen.direction(i);
  const double along = direction.dot(stretch.tangent), across = direction.dot(stretch.normal);
  const double fading = seen.change(stretch.first, stretch.last) / stretch.length;
  const double bend = curvature_at(seen.line, i, seen.reach).dot(stretch.normal);
  const double limit = kLargestShift * std::sqrt(variance);
  const double shift = std::clamp(variance * along * (across * fading - 0.5 * along * bend), -limit, limit);
  return {whole * shift, whole};
}

}  // namespace

void find_sheet_shifts(const Camera& camera, const Plane& plane, std::span<const StripePoint> line,
                       std::vector<SheetShift>& shifts) {
  shifts.assign(line.size(), SheetShift{});
  if (line.size() < kFewestWidths) return;
  std::vector<double> scratch;
  for (const StripePoint& p : line) scratch.push_back(p.width);
  SeenSheet seen;
  seen.line = line;
  seen.reach = static_cast<std::size_t>(std::lround(std::clamp(upper_median(scratch), 3.0, 1e3)));
  if (line.size() < 4 * seen.reach) return;
  for (std::size_t i = 0; i < line.size(); i += kProjected)
    seen.directions.push_back(direction_at(camera, plane, line[i]));
  seen.directions.push_back(direction_at(camera, plane, line.back()));
  const double variance = sheet_variance(seen, scratch);
  if (!(variance > 0)) return;
  for (const StripePoint& p : line) seen.brightness.push_back(std::log(std::max(p.strength, 1e-9)));
  seen.grain = grain_of(seen, scratch);
  for (std::size_t i = 0; i < line.size(); ++i) shifts[i] = shift_at(seen, i, variance);
}

StripePoint in_sheet_middle(const StripePoint& p, const SheetShift& shift) {
  StripePoint out = p;
  out.x += shift.px * p.normal_x;
  out.y += shift.px * p.normal_y;
  const double undone = shift.told * (1 - kLeftOfFade * kLeftOfFade) * double{p.fade_px} * p.fade_px;
  out.sigma_px = std::sqrt(std::max(0.0, p.sigma_px * p.sigma_px - undone));
  return out;
}

}  // namespace lightstripe
