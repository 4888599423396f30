// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What the adjustment's covariance means: sigma of every parameter, and millimetres in the section.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "calib/adjust/joint_adjustment.h"
#include "core/section_bends.h"

namespace lightstripe {

/// 1-sigma by name: "gauge.camera.fx" (px; k1.. without unit), "gauge.laser_planes.0.normal_deg" and
/// ".offset_mm" (camera frame), "field.pose.rotation_deg" and ".translation_mm" (in the first sensor's
/// frame), "board.warp_x_mm", "motion.direction_deg", "motion.axis_point_mm". Directions, rotations and
/// points: root of the summed variances of their components.
std::map<std::string, double> parameter_sigmas(const SessionViews& session,
                                               const JointAdjustment& adjustment);

/// Covariance of f(state) by what the views leave open of the shared unknowns: J C J^T, J by central
/// differences.
Eigen::MatrixXd covariance_of(const JointAdjustment& adjustment,
                              const std::function<Eigen::VectorXd(const RigState&)>& f);

/// Errors of the points (y, z of the rig frame) where the calibration saw stripes, over all sensors together:
/// root mean square of their length, mm.
struct SectionUncertainty {
  double absolute_mm = 0;
  double shape_mm = 0;  ///< after the best rigid move in the section plane
};

SectionUncertainty section_uncertainty(const SessionViews& session, const JointAdjustment& adjustment,
                                       const Eigen::Vector3d& up);

/// The independent errors that make up shape_mm, the largest first, until 95 % of its square; as polynomials
/// of the section, which extrapolate beyond the boards' stripes. None where too few stripe points were used.
SectionBends section_bends(const SessionViews& session, const JointAdjustment& adjustment,
                           const Eigen::Vector3d& up);

/// The pixels for which section_uncertainty stands: the used stripe points, at most 150 a laser plane.
struct SectionSample {
  int sensor = 0, plane = 0;
  Eigen::Vector2d pixel;
};
std::vector<SectionSample> section_samples(const SessionViews& session, const std::vector<Residual>& list);

/// (y, z) in the rig frame of every sample, one after the other; a ray that misses the plane gives (0, 0).
Eigen::VectorXd section_of(const RigState& state, MotionType motion, const Eigen::Vector3d& up,
                           const std::vector<SectionSample>& samples);

/// d section_of / d(shared unknowns of the covariance), 2n x m.
Eigen::MatrixXd section_jacobian(const SessionViews& session, const JointAdjustment& adjustment,
                                 const Eigen::Vector3d& up, const std::vector<SectionSample>& samples);

/// Orthogonal projector that takes the rigid motions of the section's points (two shifts, one turn) out of a
/// displacement of all of them; 2n x 2n.
Eigen::MatrixXd without_rigid_motion(const Eigen::VectorXd& section);

}  // namespace lightstripe
