// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Observations -> rig: one joint bundle adjustment over intrinsics, distortion, board poses, laser planes,
// sensor-to-sensor transforms and motion.
#pragma once

#include "calib/calibration.h"
#include "calib/observations.h"

namespace lightstripe {

CalibrationResult calibrate_rig(const CalibrationObservations& observations,
                                const CalibrationOptions& options = {});

}  // namespace lightstripe
