// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "calib/adjust/rig_frame.h"
#include "calib/assess/board_spread.h"
#include "calib/assess/diagnosis.h"
#include "core/linear_algebra.h"

namespace lightstripe {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

/// A displacement of the section's points, taken apart.
struct Part {
  double amount_mm = 0;  ///< rms over the points
  std::string words;
};

double rms(const VectorXd& displacement) {
  return std::sqrt(2 * displacement.squaredNorm() / static_cast<double>(displacement.size()));
}

/// Shift towards the first camera, shift across, turn and scale about the middle; what is left is bending.
std::vector<Part> parts_of(const VectorXd& section, const VectorXd& displacement,
                           const Vector2d& range_direction) {
  const Eigen::Index n = section.size() / 2;
  const Eigen::Map<const Eigen::Matrix2Xd> points(section.data(), 2, n);
  const Vector2d middle = points.rowwise().mean(), across(-range_direction.y(), range_direction.x());
  std::array<VectorXd, 4> modes;
  modes.fill(VectorXd(2 * n));
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vector2d p = points.col(i) - middle;
    modes[0].segment<2>(2 * i) = range_direction;
    modes[1].segment<2>(2 * i) = across;
    modes[2].segment<2>(2 * i) = Vector2d(-p.y(), p.x());
    modes[3].segment<2>(2 * i) = p;
  }
  static constexpr std::array<const char*, 4> kWords{
      "range: all points together nearer or farther by {:.3f} mm",
      "place across the range: all points together by {:.3f} mm",
      "turn of the section, {:.3f} mm at its points", "scale of the section, {:.3f} mm at its points"};
  std::vector<Part> parts;
  VectorXd rest = displacement;
  for (std::size_t k = 0; k < modes.size(); ++k) {
    const VectorXd along = modes[k] * modes[k].dot(displacement) / modes[k].squaredNorm();
    rest -= along;
    parts.push_back({rms(along), fmt::format(fmt::runtime(kWords[k]), rms(along))});
  }
  parts.push_back({rms(rest), fmt::format("shape of the section: bent by {:.3f} mm", rms(rest))});
  return parts;
}

/// What the views lack most, of the sensor that lacks it most.
std::string advice(const SessionViews& session, const std::vector<BoardSpread>& spreads) {
  constexpr double kEnoughTiltDeg = 25;
  constexpr double kEnoughDepth = 0.1;  // of the distance
  constexpr double kEnoughCoverage = 0.5;
  std::string text;
  double least = 1;
  const auto consider = [&](double share, const std::string& words) {
    if (share >= least) return;
    least = share;
    text = words;
  };
  for (std::size_t s = 0; s < session.sensor_names.size(); ++s) {
    const auto& name = session.sensor_names[s];
    const double tilt = spreads[s].tilt_deg;
    const auto& given = session.given_cameras[s];
    consider(
        given && given->fixed ? 1.0 : tilt / kEnoughTiltDeg,
        fmt::format("sensor {}: boards tilted by {:.0f} degrees at most; tilt them by 20 to 45", name, tilt));
    if (spreads[s].laser_angles_deg.empty()) continue;
    const DepthRange& depth = spreads[s].stripe_depths;
    consider(
        (depth.far_mm - depth.near_mm) / std::max(1.0, kEnoughDepth * depth.far_mm),
        fmt::format("sensor {}: stripes between {:.0f} and {:.0f} mm of depth only; hold boards nearer and "
                    "farther",
                    name, depth.near_mm, depth.far_mm));
    const double coverage = spreads[s].stripe_coverage;
    consider(
        coverage / kEnoughCoverage,
        fmt::format("sensor {}: stripes in {:.0f} % of the image's diagonal only; bring boards to all of the "
                    "measuring range",
                    name, 100 * coverage));
  }
  return text.empty() ? "tilt, depth and place of the boards are well spread: more views reduce it, 4 times "
                        "as many to "
                        "half"
                      : text;
}

}  // namespace

std::string weakest_direction(const SessionViews& session, const JointAdjustment& adjustment,
                              const std::vector<BoardSpread>& spreads, const SectionErrors& errors,
                              const Eigen::Vector3d& up) {
  if (!errors.known()) return {};
  const MatrixXd A = errors.jacobian * symmetric_root(adjustment.covariance);
  const SymmetricEigen eigen = symmetric_eigen(A.transpose() * A);
  const VectorXd displacement = A * eigen.vectors.rightCols<1>();
  const Rigid3 rig = rig_from_first(adjustment.state, session.motion, up);
  const Vector2d towards = (rig.rotation * Eigen::Vector3d::UnitZ()).tail<2>();
  const Vector2d range = towards.norm() > 0.1 ? Vector2d(towards.normalized()) : Vector2d::UnitY();
  const auto parts = parts_of(errors.section, displacement, range);
  const auto largest = std::max_element(
      parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.amount_mm < b.amount_mm; });
  return largest->words + " (1 sigma); " + advice(session, spreads);
}

}  // namespace lightstripe
