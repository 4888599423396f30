// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// How well a rig measures boards that it was not calibrated with: laser against board, sensor against sensor,
// travel against scale.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calib/observations.h"
#include "core/fields.h"
#include "core/rig.h"

namespace lightstripe {

/// Limits of a daily check; 0: not checked.
struct VerifyLimits {
  double max_plane_rms_mm = 0;     ///< stripe points off the board's plane, rms of a sensor
  double max_length_error_mm = 0;  ///< distances along the stripe, rms of a sensor
  double max_gap_mm = 0;           ///< between two sensors that see the same board, rms of a pair
  double max_travel_mm = 0;        ///< of the fixed board over the travel, rms
};

template <class V>
void visit_fields(V&& v, VerifyLimits& o) {
  v("max_plane_rms_mm", o.max_plane_rms_mm,
    "stripe points off the board's plane, rms of each sensor; 0: no limit");
  v("max_length_error_mm", o.max_length_error_mm,
    "distances along the board, rms of each sensor; 0: no limit");
  v("max_gap_mm", o.max_gap_mm, "gap between two sensors on one board, rms of each pair; 0: no limit");
  v("max_travel_mm", o.max_travel_mm, "place of the fixed board over the travel, rms; 0: no limit");
}

/// One view of one laser plane. The board's pose comes from the corners, the stripe from the laser plane.
struct VerifiedView {
  std::string sensor, pose, image;
  int laser_plane = 0;
  int corners = 0;
  double corner_rms_px = 0;  ///< length of the residual, with the rig's camera and the best pose
  int stripe_points = 0;     ///< 0: no stripe, and no mm below
  double plane_mean_mm = 0;  ///< signed distance to the board, > 0 behind it
  double plane_rms_mm = 0;
  double plane_max_mm = 0;     ///< largest magnitude
  double length_mm = 0;        ///< of the stripe on the board, by the corners' pitch
  double length_error_mm = 0;  ///< what the rig measures for it less that
};

/// Two sensors on the same pose of the board.
struct VerifiedPair {
  std::string sensor, other, pose;
  std::optional<double>
      gap_mm;                ///< step between the two sensors' stripes across the board; needs both stripes
  double centre_gap_mm = 0;  ///< distance between the board's middles as both see them
};

struct Verification {
  std::vector<VerifiedView> views;
  std::vector<VerifiedPair> pairs;
  std::optional<double> travel_rms_mm;  ///< of the fixed board, brought back to travel 0
};

/// `rig` has every sensor of the observations by name.
Verification verify_rig(const CalibrationObservations& observations, const Rig& rig);

/// What the limits forbid, one sentence each; empty: passed.
std::vector<std::string> exceeded(const Verification& verification, const VerifyLimits& limits);

/// Root mean square over the views of a sensor, or the pairs of two sensors, by name.
struct VerifiedSensor {
  std::string name;
  int views = 0;
  double corner_rms_px = 0, plane_rms_mm = 0, length_error_mm = 0;
};
struct VerifiedSeam {
  std::string sensor, other;
  int poses = 0;
  double gap_mm = 0, centre_gap_mm = 0;
};
std::vector<VerifiedSensor> by_sensor(const Verification& verification);
std::vector<VerifiedSeam> by_seam(const Verification& verification);

}  // namespace lightstripe
