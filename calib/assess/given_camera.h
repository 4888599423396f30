// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Whether a camera that the user gave is the one that took the pictures.
#pragma once

#include <vector>

#include "calib/adjust/joint_adjustment.h"
#include "calib/assess/verdict.h"

namespace lightstripe {

/// Adjusts once more with each fixed given camera set free (from four boards on): where the corners then fit
/// much better, the camera's file is of another lens, focus, picture size or model (fisheye coefficients
/// under OpenCV's name). Throws NotUsable with both figures.
void refuse_wrong_camera(const SessionViews& session, const JointAdjustment& adjustment,
                         const std::vector<SensorQuality>& quality, const CalibrationOptions& options);

}  // namespace lightstripe
