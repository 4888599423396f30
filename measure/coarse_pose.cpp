// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/coarse_pose.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/robust.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

struct Tried {
  SectionPose pose;
  double cost = 0;
};

std::vector<Vector2d> thinned(const Section& section) {
  constexpr std::size_t kPoints = 48;
  std::vector<Vector2d> out;
  const std::size_t step = std::max<std::size_t>(1, section.size() / kPoints);
  for (std::size_t i = step / 2; i < section.size(); i += step) out.push_back(section[i].position);
  return out;
}

/// The point of the section that is laid near the reference's top: the highest, a rail's in the middle of the
/// width.
Vector2d anchor_of(const std::vector<Vector2d>& points, ObjectKind kind) {
  std::vector<double> u, v;
  for (const Vector2d& p : points) u.push_back(p.x()), v.push_back(p.y());
  const double top = quantile(v, 0.985);
  if (kind == ObjectKind::kRail) return {(quantile(u, 0.02) + quantile(u, 0.98)) / 2, top};
  double sum = 0, count = 0;
  for (const Vector2d& p : points)
    if (p.y() > top - 3) sum += p.x(), count += 1;
  return {sum / std::max(count, 1.0), top};
}

/// Sum over the points; stops where it exceeds `limit`.
double cost_of(const std::vector<Vector2d>& points, const Vector2d& shift, const ReferenceShape& reference,
               double limit) {
  constexpr double kFarMm = 5;
  double sum = 0;
  for (const Vector2d& p : points) {
    const double d = std::min(kFarMm, reference.coarse_distance(p + shift));
    sum += d * d;
    if (sum >= limit) break;
  }
  return sum;
}

struct Grid {
  double half_u, step_u, low_v, high_v, step_v;
};

void try_shifts(const std::vector<Vector2d>& turned, bool mirrored, double angle_rad,
                const ReferenceShape& reference, std::vector<Tried>& tried) {
  const bool rail = reference.kind() == ObjectKind::kRail;
  // A rail's top is worn, its width may be seen in half; a wheel's flange tip is worn little.
  const Grid grid = rail ? Grid{48, 4, -14, 2, 2} : Grid{16, 4, -6, 6, 2};
  const Vector2d base = Vector2d(reference.top_u(), reference.top_v()) - anchor_of(turned, reference.kind());
  Tried best;
  best.cost = 1e300;
  for (double u = -grid.half_u; u <= grid.half_u; u += grid.step_u)
    for (double v = grid.low_v; v <= grid.high_v; v += grid.step_v) {
      const Vector2d shift = base + Vector2d(u, v);
      const double cost = cost_of(turned, shift, reference, best.cost);
      if (cost < best.cost) best = {{mirrored, {angle_rad, shift}}, cost};
    }
  tried.push_back(best);
}

}  // namespace

std::vector<SectionPose> coarse_poses(const Section& section, const ReferenceShape& reference,
                                      const CoarsePoseOptions& options) {
  constexpr double kStepDeg = 3;
  LIGHTSTRIPE_CHECK(section.size() >= 3, "a pose needs three points");
  const std::vector<Vector2d> points = thinned(section);
  const double radians = std::numbers::pi / 180;
  const int steps = static_cast<int>(std::floor(options.max_tilt_deg / kStepDeg + 1e-9));
  std::vector<Tried> tried;
  for (int mirrored = 0; mirrored <= (options.may_mirror ? 1 : 0); ++mirrored)
    for (int upside_down = 0; upside_down <= (options.may_be_upside_down ? 1 : 0); ++upside_down)
      for (int k = -steps; k <= steps; ++k) {
        const double angle = k * kStepDeg * radians + (upside_down == 1 ? std::numbers::pi : 0.0);
        std::vector<Vector2d> turned = points;
        for (Vector2d& p : turned) {
          if (mirrored == 1) p.x() = -p.x();
          p = Eigen::Rotation2Dd(angle) * p;
        }
        try_shifts(turned, mirrored == 1, angle, reference, tried);
      }
  std::stable_sort(tried.begin(), tried.end(),
                   [](const Tried& a, const Tried& b) { return a.cost < b.cost; });
  std::vector<SectionPose> out;
  for (const Tried& one : tried)
    if (static_cast<int>(out.size()) < options.candidates) out.push_back(one.pose);
  return out;
}

}  // namespace lightstripe
