// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Results of the chain beside the truth that the simulator wrote: rig against rig, sections against sections,
// points against the stripes that were to be seen.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/profile.h"
#include "core/rig.h"
#include "measure/measure_profile.h"

namespace lightstripe {

struct SensorError {
  std::string name;
  double plane_angle_deg = 0;  ///< between the laser planes, camera frame
  double plane_offset_mm = 0;  ///< along the true normal, at the middle of the measuring volume
  double focal_relative = 0;   ///< of fx
};

struct RigError {
  std::vector<SensorError> sensors;
  double baseline_mm = 0;   ///< largest error of a sensor's place against the first sensor
  double baseline_deg = 0;  ///< largest error of a sensor's turn against the first sensor
  double travel_deg = 0;    ///< direction of travel or of the axis, first sensor's camera frame
  double axis_mm = 0;       ///< rotary: distance between the axes where they pass nearest to the rig
};

RigError compare_rigs(const Rig& rig, const Rig& truth);

struct CloudError {
  double shape_rms_mm = 0;        ///< sections against the true shape, each after one rigid move
  double absolute_rms_mm = 0;     ///< without the move, points within 5 mm of the shape
  double far_fraction = 0;        ///< points farther than 1 mm from the moved shape
  double recovered_fraction = 0;  ///< of the visible lit stripe
  long points = 0;
};

/// `rig` is the one that the profiles were made with. `truth` is the folder that simulate_scene writes
/// (sections.csv, stripes.csv).
CloudError compare_cloud(const std::vector<Profile>& profiles, const Rig& rig,
                         const std::filesystem::path& truth);

/// Of one measured quantity, over the frames in which it is known.
struct QuantityError {
  std::string name;
  double rms_mm = 0, worst_mm = 0, mean_mm = 0;
  int frames = 0;
};

/// Compares with the wear.csv of the truth: a rail's vertical and side wear; a wheel's flange height, flange
/// thickness, qR and diameter. Quantities that no frame knows are left out.
std::vector<QuantityError> compare_wear(const std::vector<MeasuredFrame>& rows, ObjectKind kind,
                                        const std::filesystem::path& truth);

}  // namespace lightstripe
