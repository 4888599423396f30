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

/// The pixels for which section_uncertainty stands: the used stripe points, at most 150 a laser plane.
struct SectionSample {
  int sensor = 0, plane = 0;
  Eigen::Vector2d pixel;
};
std::vector<SectionSample> section_samples(const SessionViews& session, const std::vector<Residual>& list);

/// (y, z) in the rig frame of every sample, one after the other; a ray that misses the plane gives (0, 0).
Eigen::VectorXd section_of(const RigState& state, MotionType motion, const Eigen::Vector3d& up,
                           const std::vector<SectionSample>& samples);

/// (u, v) of every sample as a rotary scan has them: place along the axis, which grows with the rig's y, and
/// distance from it.
Eigen::VectorXd axial_section_of(const RigState& state, const Eigen::Vector3d& up,
                                 const std::vector<SectionSample>& samples);

/// d section_of / d(shared unknowns of the covariance), 2n x m.
Eigen::MatrixXd section_jacobian(const SessionViews& session, const JointAdjustment& adjustment,
                                 const Eigen::Vector3d& up, const std::vector<SectionSample>& samples);

/// Where the calibration saw stripes, and how these places move with the shared unknowns: computed once for
/// all that ask what the calibration errs by.
struct SectionErrors {
  std::vector<SectionSample> samples;
  Eigen::VectorXd section;   ///< see section_of
  Eigen::MatrixXd jacobian;  ///< see section_jacobian; empty where fewer than three samples are there
  bool known() const { return jacobian.size() > 0; }
};
SectionErrors section_errors(const SessionViews& session, const JointAdjustment& adjustment,
                             const Eigen::Vector3d& up);
/// The same of axial_section_of(), for a rig with an axis.
SectionErrors axial_section_errors(const JointAdjustment& adjustment, const Eigen::Vector3d& up,
                                   std::vector<SectionSample> samples);

SectionUncertainty section_uncertainty(const SectionErrors& errors, const Eigen::MatrixXd& covariance);

/// How a measurement lays a section: a linear scan's on parts that do not wear, wherever they are (two shifts
/// and a turn are free); a rotary scan's only along its axis, because its radii and its tilt against the axis
/// are measured.
enum class SectionFreedom { kRigid, kAlongAxis };

/// Independent errors of the calibration as what they do to a section beyond its freedom; as polynomials of
/// the section, which extrapolate beyond the boards' stripes. As many as hold 95 % of the squared
/// displacement of the whole section, and 95 % of what bends each sensor's part of it and each pair's: a
/// rail's wear is seen by one or two sensors, however far the calibration may shift them against those over
/// the other rail. None where too few stripe points were used.
SectionBends section_bends(const SectionErrors& errors, const Eigen::MatrixXd& covariance,
                           SectionFreedom freedom);
/// With the freedom of the session's kind of motion. `errors`: see section_errors().
SectionBends section_bends(const SessionViews& session, const JointAdjustment& adjustment,
                           const SectionErrors& errors, const Eigen::Vector3d& up);

/// How many of a section's rigid motions are left out: the shift along y or the axis, the other shift, the
/// turn.
enum RigidMotions : int { kShiftAlong = 1, kShifts = 2, kAllMotions = 3 };

/// Displacements of all points of the section (2n x k) less the first `motions` rigid motions that fit each
/// of them best.
Eigen::MatrixXd without_rigid_motion(const Eigen::VectorXd& section, const Eigen::MatrixXd& displacements,
                                     RigidMotions motions = kAllMotions);

}  // namespace lightstripe
