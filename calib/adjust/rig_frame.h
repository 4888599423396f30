// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// From the adjustment's frame (the first camera) to the rig frame of docs/conventions.md.
#pragma once

#include <Eigen/Core>

#include "calib/adjust/rig_state.h"
#include "core/rig.h"

namespace lightstripe {

/// x = direction of travel; without a linear motion the first laser plane's normal, which looks away from the
/// camera. z = `up` (first camera frame) made orthogonal to x. Throws NotUsable where up is parallel to x
/// within 3 degrees.
Rigid3 rig_from_first(const RigState& state, MotionType motion, const Eigen::Vector3d& up);

/// Rotary: the axis' point that is nearest to the first camera, which is the rig's origin.
Eigen::Vector3d nearest_point_of_axis(const MotionState& motion);

/// The calibrated rig without its quality. Rotary motion: the axis is turned so that it grows with y; where
/// that turns the sense of rotation, `moves` changes sides, which is the same motion. Its point is the
/// one nearest to the rig's origin.
Rig rig_of(const SessionViews& session, const RigState& state, const Eigen::Vector3d& up);

}  // namespace lightstripe
