// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/assess/given_camera.h"

#include <fmt/format.h>

namespace lightstripe {
namespace {

constexpr int kMinBoards = 4;

/// rms of the sensor's corners with its camera set free, px; 0 where the boards do not tell a camera.
double rms_with_free_camera(SessionViews session, const JointAdjustment& adjustment, std::size_t sensor,
                            const CalibrationOptions& options) {
  session.given_cameras[sensor]->fixed = false;
  auto lenses = adjustment.lenses;
  lenses[sensor] = LensModel::kBrown4;
  const JointAdjustment freed = adjust_jointly(session, adjustment.state, lenses, options);
  return freed.converged ? sensor_quality(session, freed.residuals)[sensor].board_rms_px : 0;
}

}  // namespace

void refuse_wrong_camera(const SessionViews& session, const JointAdjustment& adjustment,
                         const std::vector<SensorQuality>& quality, const CalibrationOptions& options) {
  constexpr double kMuch_px = 0.15, kTimes = 2;
  for (std::size_t s = 0; s < quality.size(); ++s) {
    const auto& given = session.given_cameras[s];
    const double rms = quality[s].board_rms_px;
    if (!given || !given->fixed || quality[s].board_views < kMinBoards || rms < kMuch_px) continue;
    const double free_rms = rms_with_free_camera(session, adjustment, s, options);
    if (free_rms <= 0 || rms < kTimes * free_rms) continue;
    throw NotUsable(fmt::format(
        "sensor {}: the given camera did not take these pictures: the corners miss the board by {:.2f} px, "
        "but by {:.2f} px with a camera found from them; check that the file is of this lens, focus and "
        "picture size, in OpenCV's pinhole model (no fisheye), or leave it out",
        quality[s].name, rms, free_rms));
  }
}

}  // namespace lightstripe
