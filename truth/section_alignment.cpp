// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "truth/section_alignment.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/error.h"
#include "core/linear_algebra.h"
#include "core/polyline_search.h"
#include "core/robust.h"

namespace lightstripe {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

using Feet = std::vector<std::optional<PolylineFoot>>;

Feet find_feet(std::span<const Vector2d> measured, const SectionMove& move, const PolylineSearch& shape) {
  Feet feet;
  feet.reserve(measured.size());
  for (const Vector2d& p : measured) feet.push_back(shape.nearest(move * p));
  return feet;
}

/// Of the absolute distances; points without a counterpart count with `search_mm`.
double median_distance(const Feet& feet, double search_mm) {
  std::vector<double> distances;
  distances.reserve(feet.size());
  for (const auto& foot : feet) distances.push_back(foot ? std::abs(foot->signed_distance) : search_mm);
  return upper_median(distances);
}

struct Step {
  Vector3d change;  ///< turn about the centre times `radius_mm`, then the two shifts: all mm
  bool determined = false;
};

/// One weighted Gauss-Newton step on the signed distances n.(R p + t - foot), in the eigenvectors of its
/// normal matrix.
Step alignment_step(std::span<const Vector2d> measured, const Feet& feet, const SectionMove& move,
                    const Vector2d& centre, double radius_mm, double scale) {
  constexpr double kHeld = 1e-6;  // share of the largest eigenvalue below which the shape does not hold
  Matrix3d H = Matrix3d::Zero();
  Vector3d g = Vector3d::Zero();
  for (std::size_t i = 0; i < feet.size(); ++i) {
    if (!feet[i] || feet[i]->beyond_end) continue;
    const double weight = tukey_weight(feet[i]->signed_distance / scale);
    const Vector2d arm = (move * measured[i] - centre) / radius_mm, n = feet[i]->normal;
    const Vector3d J(arm.x() * n.y() - arm.y() * n.x(), n.x(), n.y());
    H += weight * J * J.transpose();
    g += weight * feet[i]->signed_distance * J;
  }
  const SymmetricEigen eigen = symmetric_eigen(H);
  const double floor = kHeld * eigen.values.z();
  Step step{Vector3d::Zero(), eigen.values.x() > floor};
  for (int i = 0; i < 3; ++i)
    if (eigen.values(i) > floor)
      step.change -= eigen.vectors.col(i) * (eigen.vectors.col(i).dot(g) / eigen.values(i));
  return step;
}

/// The move, then a turn about `centre` and a shift.
SectionMove composed(const SectionMove& move, double angle_rad, const Vector2d& centre,
                     const Vector2d& shift) {
  const Vector2d turned = Eigen::Rotation2Dd(angle_rad) * (move.translation - centre);
  return {move.angle_rad + angle_rad, turned + centre + shift};
}

void judge(const Feet& feet, const SectionAlignmentOptions& options, SectionAlignment& out) {
  double sum_squares = 0;
  for (const auto& foot : feet) {
    if (!foot || std::abs(foot->signed_distance) > options.far_mm) continue;
    sum_squares += foot->signed_distance * foot->signed_distance;
    ++out.num_points;
  }
  out.rms_mm = out.num_points > 0 ? std::sqrt(sum_squares / out.num_points) : 0.0;
  out.far_fraction = 1.0 - out.num_points / static_cast<double>(feet.size());
  out.median_mm = median_distance(feet, options.search_mm);
}

/// Centre and rms radius of the measured points: the turn is taken about the one and scaled by the other.
std::pair<Vector2d, double> centre_and_radius(std::span<const Vector2d> measured) {
  Vector2d centre = Vector2d::Zero();
  for (const Vector2d& p : measured) centre += p / static_cast<double>(measured.size());
  double squares = 0;
  for (const Vector2d& p : measured)
    squares += (p - centre).squaredNorm() / static_cast<double>(measured.size());
  return {centre, std::sqrt(squares)};
}

}  // namespace

SectionAlignment align_section(std::span<const Vector2d> measured, std::span<const Vector2d> shape,
                               const SectionAlignmentOptions& options) {
  constexpr double kSmallStep = 1e-7;  // mm
  LIGHTSTRIPE_CHECK(measured.size() >= 3, "an alignment needs three points");
  LIGHTSTRIPE_CHECK(options.far_mm > 0 && options.far_mm <= options.search_mm,
                    "far_mm must not exceed search_mm");
  LIGHTSTRIPE_CHECK(options.min_scale_mm > 0, "min_scale_mm must be positive");
  const PolylineSearch search(shape, options.search_mm);
  const auto [centre, radius_mm] = centre_and_radius(measured);
  LIGHTSTRIPE_CHECK(radius_mm > 0, "the measured points must not all be one");

  SectionAlignment out;
  Feet feet = find_feet(measured, out.shape_from_measured, search);
  for (int i = 0; i < options.max_iterations && !out.converged; ++i) {
    const double scale =
        std::max(options.min_scale_mm, kMadToSigma * median_distance(feet, options.search_mm));
    const Vector2d here = out.shape_from_measured * centre;
    const Step step = alignment_step(measured, feet, out.shape_from_measured, here, radius_mm, scale);
    out.shape_from_measured =
        composed(out.shape_from_measured, step.change.x() / radius_mm, here, step.change.tail<2>());
    out.determined = step.determined;
    out.converged = step.change.norm() < kSmallStep;
    feet = find_feet(measured, out.shape_from_measured, search);
  }
  judge(feet, options, out);
  return out;
}

}  // namespace lightstripe
