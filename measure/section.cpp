// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/section.h"

#include <algorithm>
#include <cmath>

#include "core/linear_algebra.h"
#include "core/robust.h"

namespace lightstripe {
namespace {

using Eigen::Vector3d;

/// Every n-th point of all profiles, at most about 2000.
std::vector<ProfilePoint> thinned(const std::vector<Profile>& profiles) {
  constexpr std::size_t kMost = 2000;
  std::size_t total = 0;
  for (const Profile& profile : profiles) total += profile.points.size();
  const std::size_t step = total / kMost + 1;
  std::vector<ProfilePoint> out;
  std::size_t i = 0;
  for (const Profile& profile : profiles)
    for (const ProfilePoint& point : profile.points)
      if (i++ % step == 0) out.push_back(point);
  return out;
}

/// Full weight up to twice the median error, then by its square.
void weigh_by_sigma(Section& section) {
  std::vector<double> sigmas;
  for (const SectionPoint& point : section) sigmas.push_back(point.sigma_mm);
  if (sigmas.empty()) return;
  const double usual = 2 * median(std::move(sigmas));
  if (!(usual > 0)) return;
  for (SectionPoint& point : section)
    if (point.sigma_mm > usual) point.weight = usual * usual / (point.sigma_mm * point.sigma_mm);
}

/// What a point counts `inside` mm from its stripe's end. There, where the surface turns away or something
/// hides it, half of the filter's window sees nothing: the last points are a tenth of a millimetre off, 0.02
/// at 5 mm, 0.007 at 8 mm, nothing at 11 mm (simulated wheel's flange, both sensors); against a scatter of
/// 0.004.
double end_weight(double inside_mm) {
  constexpr double kBadMm = 5, kGoodMm = 11, kShare = 0.05;
  const double share = std::max(0.0, inside_mm - kBadMm) / (kGoodMm - kBadMm);
  return std::clamp(share * share, kShare, 1.0);
}

/// Points near a stripe's end count where there is nothing better, all of a stripe shorter than 6 mm hardly
/// ever.
void weigh_ends(Section& section) {
  constexpr double kShortMm = 6, kShortShare = 0.05;
  for (std::size_t begin = 0, end = 0; begin < section.size(); begin = end) {
    while (end < section.size() && section[end].chain == section[begin].chain) ++end;
    const Eigen::Vector2d first = section[begin].position, last = section[end - 1].position;
    const double whole = (last - first).norm() < kShortMm ? kShortShare : 1.0;
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector2d& p = section[i].position;
      section[i].weight *= whole * end_weight(std::min((p - first).norm(), (p - last).norm()));
    }
  }
}

}  // namespace

Section section_of(const Profile& profile) {
  Section section;
  section.reserve(profile.points.size());
  int chain = -1;
  const ProfilePoint* last = nullptr;
  for (const ProfilePoint& point : profile.points) {
    if (!last || last->sensor != point.sensor || last->line != point.line) ++chain;
    section.push_back({{point.u, point.v}, chain, point.sensor, point.sigma_mm, 1.0});
    last = &point;
  }
  weigh_by_sigma(section);
  weigh_ends(section);
  return section;
}

bool sections_are_radial(const std::vector<Profile>& profiles) {
  constexpr double kRoundingMm = 1e-3;  // profiles.csv has five decimals
  const std::vector<ProfilePoint> points = thinned(profiles);
  if (points.size() < 8) return false;
  double from_axes = 0;  // of the rig frame: a linear motion's u, v are y, z
  for (const ProfilePoint& point : points)
    from_axes =
        std::max({from_axes, std::abs(point.u - point.position.y()), std::abs(point.v - point.position.z())});
  if (from_axes < kRoundingMm) return false;
  const auto n = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd A(n, 4);
  Eigen::VectorXd u(n), squares(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const ProfilePoint& point = points[static_cast<std::size_t>(i)];
    A.row(i) << point.position.transpose(), 1;
    u(i) = point.u;
    squares(i) = point.position.squaredNorm() - point.v * point.v - point.u * point.u;
  }
  // u = d.p - c along the axis direction d; with q = p - a off the axis, |p|^2 - v^2 - u^2 is linear in p.
  const Eigen::VectorXd along = solve_least_squares(A, u), off = solve_least_squares(A, squares);
  const double scale = std::sqrt(A.leftCols<3>().rowwise().squaredNorm().maxCoeff());
  return std::abs(along.head<3>().norm() - 1) < 1e-3 && (A * along - u).cwiseAbs().maxCoeff() < kRoundingMm &&
         (A * off - squares).cwiseAbs().maxCoeff() < kRoundingMm * 4 * scale;
}

}  // namespace lightstripe
