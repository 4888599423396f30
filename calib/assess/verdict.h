// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Whether a calibration can be used, and what a user should know about it.
#pragma once

#include <string>
#include <vector>

#include "calib/adjust/joint_adjustment.h"
#include "calib/assess/board_spread.h"
#include "calib/assess/diagnosis.h"
#include "core/rig.h"

namespace lightstripe {

/// Rms of each view's used corners and points, px; corners as length of the 2D residual.
std::vector<ViewResidual> view_residuals(const SessionViews& session, const std::vector<Residual>& list);

/// The same by sensor.
std::vector<SensorQuality> sensor_quality(const SessionViews& session, const std::vector<Residual>& list);

/// Throws NotUsable where the adjustment failed or its result must not be used. Needs no covariance.
void refuse_bad_adjustment(const SessionViews& session, const JointAdjustment& adjustment,
                           const std::vector<SensorQuality>& quality,
                           const std::vector<BoardSpread>& spreads);

/// For each laser plane, how many of the stripes that were found lie in it at the end.
std::vector<StripeAgreement> stripe_agreement(const SessionViews& session, const JointAdjustment& adjustment);

/// Throws NotUsable where the larger part of a laser's stripes, of the poses that two sensors share or of the
/// positions of travel does not fit the adjusted rig.
void refuse_disagreement(const SessionViews& session, const JointAdjustment& adjustment);

/// Throws NotUsable where the boards lie so near or so far that the unit of the squares must be wrong, unless
/// a travel or the declared measuring range vouches for the scale.
void refuse_wrong_unit(const SessionViews& session, const JointAdjustment& adjustment,
                       const CalibrationOptions& options);

/// Throws NotUsable where the predicted error of the section's shape is out of all proportion to the range.
void refuse_uncertain_section(const JointAdjustment& adjustment, double shape_sigma_mm);

/// Throws NotUsable where half of a sensor's boards stood within 10 degrees of the laser plane.
void refuse_parallel_lasers(const SessionViews& session, const std::vector<BoardSpread>& spreads);

/// Throws NotUsable where the stripes cover too little of the image, or of the measuring range declared.
void refuse_extrapolation(const SessionViews& session, const std::vector<BoardSpread>& spreads,
                          const CalibrationOptions& options);

/// Throws NotUsable where the pixels found are far from square: the pitch of the board is wrong in x or y.
void refuse_oblong_pixels(const SessionViews& session, const RigState& state);

/// Throws NotUsable where a camera's distortion is not monotonic over its image.
void refuse_folded_image(const SessionViews& session, const RigState& state);

/// Throws NotUsable where two halves of the views give sections that contradict each other grossly.
void refuse_contradicting_halves(const CrossValidation& cross_validation, const JointAdjustment& adjustment);

/// Weak spots that do not forbid the use: views that hardly fit, little tilt, little coverage.
std::vector<std::string> warnings_about(const SessionViews& session, const JointAdjustment& adjustment,
                                        const std::vector<ViewResidual>& views,
                                        const std::vector<BoardSpread>& spreads);

/// Whether two halves of the views contradict each other beyond the prediction.
std::vector<std::string> warnings_about(const CrossValidation& cross_validation);

}  // namespace lightstripe
