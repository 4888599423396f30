// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/assess/uncertainty.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "calib/adjust/rig_frame.h"
#include "core/linear_algebra.h"
#include "core/transform.h"

namespace lightstripe {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// d f(state) / d(shared unknowns) by central differences of a twentieth of a sigma.
template <class F>
MatrixXd derivative(const JointAdjustment& adjustment, const F& f) {
  constexpr double kMinStep = 1e-6;  // perfect data have a sigma of nothing
  const Eigen::Index n = adjustment.covariance.rows();
  MatrixXd J;
  for (Eigen::Index j = 0; j < n; ++j) {
    const double step = std::max(kMinStep, 0.05 * std::sqrt(adjustment.covariance(j, j)));
    const VectorXd delta = step * VectorXd::Unit(n, j);
    const VectorXd column = (f(moved_state(adjustment.state, adjustment.globals, delta)) -
                             f(moved_state(adjustment.state, adjustment.globals, -delta))) /
                            (2 * step);
    if (J.size() == 0) J = MatrixXd::Zero(column.size(), n);
    J.col(j) = column;
  }
  return J;
}

/// Root of the summed variances of f's components.
double total_sigma(const JointAdjustment& adjustment, const std::function<VectorXd(const RigState&)>& f) {
  return std::sqrt(covariance_of(adjustment, f).trace());
}

void add_intrinsics(const JointAdjustment& adjustment, const GlobalBlock& block, const std::string& name,
                    std::map<std::string, double>& sigmas) {
  std::vector<std::string_view> names{"fx", "fy", "cx", "cy"};
  for (const int term : free_terms(block.lens)) names.push_back(kTermNames[static_cast<std::size_t>(term)]);
  for (int i = 0; i < block.size; ++i)
    sigmas[fmt::format("{}.camera.{}", name, names[static_cast<std::size_t>(i)])] =
        std::sqrt(adjustment.covariance(block.column + i, block.column + i));
}

void add_plane(const JointAdjustment& adjustment, const GlobalBlock& block, const std::string& sensor,
               std::map<std::string, double>& sigmas) {
  const auto s = static_cast<std::size_t>(block.sensor), p = static_cast<std::size_t>(block.plane);
  const auto name = fmt::format("{}.laser_planes.{}", sensor, block.plane);
  const auto normal = [&](const RigState& state) -> VectorXd {
    return state.sensors[s].laser_planes[p].normal;
  };
  sigmas[name + ".normal_deg"] = total_sigma(adjustment, normal) / kDegree;
  const int offset = block.column + block.size - 1;
  sigmas[name + ".offset_mm"] = std::sqrt(adjustment.covariance(offset, offset));
}

/// The turn of a pose from its mean: rotation vector, radians, for small angles.
VectorXd turn_from(const Rigid3& pose, const Eigen::Quaterniond& mean) {
  return 2 * (pose.rotation * mean.conjugate()).vec();
}

/// The sensor's pose in the first sensor's frame.
void add_pose(const JointAdjustment& adjustment, const GlobalBlock& block, const std::string& sensor,
              std::map<std::string, double>& sigmas) {
  const auto s = static_cast<std::size_t>(block.sensor);
  const Eigen::Quaterniond mean = adjustment.state.sensors[s].cam_from_first.rotation;
  const auto rotation = [&](const RigState& state) -> VectorXd {
    return turn_from(state.sensors[s].cam_from_first, mean);
  };
  const auto position = [&](const RigState& state) -> VectorXd {
    return state.sensors[s].cam_from_first.inverse().translation;
  };
  sigmas[sensor + ".pose.rotation_deg"] = total_sigma(adjustment, rotation) / kDegree;
  sigmas[sensor + ".pose.translation_mm"] = total_sigma(adjustment, position);
}

/// Where the first sensor sits on the tool.
void add_tool(const JointAdjustment& adjustment, std::map<std::string, double>& sigmas) {
  const Eigen::Quaterniond mean = adjustment.state.tool->tool_from_first.rotation;
  sigmas["tool.rotation_deg"] =
      total_sigma(adjustment,
                  [&](const RigState& state) { return turn_from(state.tool->tool_from_first, mean); }) /
      kDegree;
  sigmas["tool.translation_mm"] = total_sigma(
      adjustment, [](const RigState& s) -> VectorXd { return s.tool->tool_from_first.translation; });
}

/// Of the axis' point nearest to the camera, across the axis: along it no point is marked.
double axis_sigma_mm(const JointAdjustment& adjustment) {
  const Eigen::Vector3d axis = adjustment.state.motion->direction;
  return total_sigma(adjustment, [&axis](const RigState& state) -> VectorXd {
    const Eigen::Vector3d point = nearest_point_of_axis(*state.motion);
    return point - axis.dot(point) * axis;
  });
}

/// Where the sample's ray meets its laser plane, in the first sensor's frame.
std::optional<Eigen::Vector3d> place_in_first(const RigState& state, const SectionSample& sample) {
  const auto& sensor = state.sensors[static_cast<std::size_t>(sample.sensor)];
  const auto ray = unproject(sensor.camera, sample.pixel);
  const auto& plane = sensor.laser_planes[static_cast<std::size_t>(sample.plane)];
  const auto p = ray ? intersect(plane, Eigen::Vector3d::Zero(), *ray) : std::nullopt;
  if (!p) return std::nullopt;
  return sensor.cam_from_first.inverse() * *p;
}

constexpr std::size_t kFewestSamples = 3;  // a rigid move fits fewer of them exactly

}  // namespace

std::map<std::string, double> parameter_sigmas(const SessionViews& session,
                                               const JointAdjustment& adjustment) {
  using Kind = GlobalBlock::Kind;
  std::map<std::string, double> sigmas;
  for (const auto& block : adjustment.globals) {
    const auto& sensor = session.sensor_names[static_cast<std::size_t>(block.sensor)];
    if (block.kind == Kind::kIntrinsics) add_intrinsics(adjustment, block, sensor, sigmas);
    if (block.kind == Kind::kLaserPlane) add_plane(adjustment, block, sensor, sigmas);
    if (block.kind == Kind::kCamFromFirst) add_pose(adjustment, block, sensor, sigmas);
    for (int i = 0; block.kind == Kind::kBoardWarp && i < 2; ++i)
      sigmas[i == 0 ? "board.warp_x_mm" : "board.warp_y_mm"] =
          std::sqrt(adjustment.covariance(block.column + i, block.column + i));
    if (block.kind == Kind::kDirection)
      sigmas["motion.direction_deg"] =
          total_sigma(adjustment, [](const RigState& s) -> VectorXd { return s.motion->direction; }) /
          kDegree;
    if (block.kind == Kind::kToolFromFirst) add_tool(adjustment, sigmas);
    if (block.kind == Kind::kAxisPoint) sigmas["motion.axis_point_mm"] = axis_sigma_mm(adjustment);
  }
  return sigmas;
}

std::vector<SectionSample> section_samples(const SessionViews& session, const std::vector<Residual>& list) {
  constexpr std::size_t kMaxSamples = 150;
  std::map<std::pair<int, int>, std::vector<SectionSample>> by_plane;
  for (const auto& residual : list) {
    if (residual.is_corner() || !residual.used) continue;
    const auto& view = session.views[residual.view];
    const auto& point = view.stripes[static_cast<std::size_t>(residual.plane)][residual.index];
    by_plane[{view.sensor, residual.plane}].push_back({view.sensor, residual.plane, {point.x, point.y}});
  }
  std::vector<SectionSample> samples;
  for (const auto& [plane, all] : by_plane) {
    const std::size_t step = (all.size() + kMaxSamples - 1) / kMaxSamples;
    for (std::size_t i = 0; i < all.size(); i += step) samples.push_back(all[i]);
  }
  return samples;
}

VectorXd section_of(const RigState& state, MotionType motion, const Eigen::Vector3d& up,
                    const std::vector<SectionSample>& samples) {
  const Rigid3 rig = rig_from_first(state, motion, up);
  VectorXd section = VectorXd::Zero(2 * static_cast<Eigen::Index>(samples.size()));
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (const auto p = place_in_first(state, samples[i]))
      section.segment<2>(2 * static_cast<Eigen::Index>(i)) = (rig * *p).tail<2>();
  return section;
}

MatrixXd section_jacobian(const SessionViews& session, const JointAdjustment& adjustment,
                          const Eigen::Vector3d& up, const std::vector<SectionSample>& samples) {
  return derivative(adjustment,
                    [&](const RigState& state) { return section_of(state, session.motion, up, samples); });
}

SectionErrors section_errors(const SessionViews& session, const JointAdjustment& adjustment,
                             const Eigen::Vector3d& up) {
  SectionErrors out;
  out.samples = section_samples(session, adjustment.residuals);
  if (out.samples.size() < kFewestSamples) return out;
  out.section = section_of(adjustment.state, session.motion, up, out.samples);
  out.jacobian = section_jacobian(session, adjustment, up, out.samples);
  return out;
}

VectorXd axial_section_of(const RigState& state, const Eigen::Vector3d& up,
                          const std::vector<SectionSample>& samples) {
  const Eigen::Vector3d point = nearest_point_of_axis(*state.motion);
  Eigen::Vector3d axis = state.motion->direction.normalized();
  if ((rig_from_first(state, MotionType::kRotary, up).rotation * axis).y() < 0) axis = -axis;
  VectorXd section = VectorXd::Zero(2 * static_cast<Eigen::Index>(samples.size()));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto p = place_in_first(state, samples[i]);
    if (!p) continue;
    const Eigen::Vector3d arm = *p - point;
    const double along = axis.dot(arm);
    section.segment<2>(2 * static_cast<Eigen::Index>(i)) << along, (arm - along * axis).norm();
  }
  return section;
}

SectionErrors axial_section_errors(const JointAdjustment& adjustment, const Eigen::Vector3d& up,
                                   std::vector<SectionSample> samples) {
  SectionErrors out;
  out.samples = std::move(samples);
  if (out.samples.size() < kFewestSamples) return out;
  out.section = axial_section_of(adjustment.state, up, out.samples);
  out.jacobian =
      derivative(adjustment, [&](const RigState& state) { return axial_section_of(state, up, out.samples); });
  return out;
}

MatrixXd without_rigid_motion(const VectorXd& section, const MatrixXd& displacements, RigidMotions motions) {
  const Eigen::Index n = section.size() / 2;
  const Eigen::Map<const Eigen::Matrix2Xd> points(section.data(), 2, n);
  const Eigen::Vector2d mean = points.rowwise().mean();
  MatrixXd rigid(2 * n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector2d p = points.col(i) - mean;
    rigid.middleRows<2>(2 * i) << 1, 0, -p.y(), 0, 1, p.x();
  }
  const MatrixXd basis = orthonormal_basis(rigid).leftCols(motions);
  return displacements - basis * (basis.transpose() * displacements);
}

SectionUncertainty section_uncertainty(const SectionErrors& errors, const MatrixXd& covariance) {
  if (!errors.known()) return {};
  const MatrixXd shape = without_rigid_motion(errors.section, errors.jacobian);
  const auto rms = [&](const MatrixXd& of) {
    return std::sqrt((of * covariance).cwiseProduct(of).sum() / static_cast<double>(errors.samples.size()));
  };
  return {rms(errors.jacobian), rms(shape)};
}

Eigen::MatrixXd covariance_of(const JointAdjustment& adjustment,
                              const std::function<VectorXd(const RigState&)>& f) {
  const MatrixXd J = derivative(adjustment, f);
  return J * adjustment.covariance * J.transpose();
}

}  // namespace lightstripe
