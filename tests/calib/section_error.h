// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The error of a calibrated rig's section where the session's stripes lay, against the known rig.
#pragma once

#include <cmath>
#include <vector>

#include "calib/assess/uncertainty.h"
#include "core/rig.h"
#include "synthetic_session.h"

namespace lightstripe::testing {

struct SectionError {
  double absolute_mm = 0, shape_mm = 0;  ///< rms over the points; shape: after the best rigid move
};

inline RigState state_of(const Rig& rig) {
  RigState state;
  for (const auto& sensor : rig.sensors)
    state.sensors.push_back({sensor.camera, sensor.rig_from_camera.inverse() * rig.sensors[0].rig_from_camera,
                             sensor.laser_planes});
  state.motion.emplace();
  state.motion->direction = rig.sensors[0].rig_from_camera.rotation.conjugate() * Eigen::Vector3d::UnitX();
  return state;
}

inline RigState state_of(const SyntheticRig& truth) {
  RigState state;
  for (const auto& sensor : truth.sensors) state.sensors.push_back(sensor);
  state.motion.emplace();
  state.motion->direction = truth.direction;
  return state;
}

/// Every fifth point of the session's stripes.
inline std::vector<SectionSample> samples_of(const SyntheticRig& truth,
                                             const CalibrationObservations& observations) {
  std::vector<SectionSample> samples;
  for (std::size_t s = 0; s < truth.sensors.size(); ++s)
    for (const auto& view : observations.sensors[s].views)
      for (std::size_t p = 0; p < view.stripes.size(); ++p)
        for (std::size_t i = 0; i < view.stripes[p].size(); i += 5)
          samples.push_back(
              {static_cast<int>(s), static_cast<int>(p), {view.stripes[p][i].x, view.stripes[p][i].y}});
  return samples;
}

inline SectionError section_error(const RigState& found, const SyntheticRig& truth,
                                  const CalibrationObservations& observations) {
  const std::vector<SectionSample> samples = samples_of(truth, observations);
  const Eigen::VectorXd a = section_of(found, MotionType::kLinear, {0, -1, 0}, samples);
  const Eigen::VectorXd b = section_of(state_of(truth), MotionType::kLinear, {0, -1, 0}, samples);
  const double n = std::sqrt(static_cast<double>(samples.size()));
  return {(a - b).norm() / n, without_rigid_motion(b, a - b).norm() / n};
}

}  // namespace lightstripe::testing
