// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/assess/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/counted.h"
#include "core/robust.h"

namespace lightstripe {
namespace {

/// Intrinsics that the user gives as final need no tilted boards.
bool camera_is_fixed(const SessionViews& session, std::size_t sensor) {
  return session.given_cameras[sensor] && session.given_cameras[sensor]->fixed;
}

}  // namespace

void refuse_bad_adjustment(const SessionViews& session, const JointAdjustment& adjustment,
                           const std::vector<SensorQuality>& quality,
                           const std::vector<BoardSpread>& spreads) {
  constexpr double kMaxRmsPx = 2;    // beyond it board or stripes are not what the session says
  constexpr double kMinTiltDeg = 5;  // below it range errors exceed a millimetre at half a metre
  if (!adjustment.converged)
    throw NotUsable(
        fmt::format("the adjustment did not converge in {}; look for views with a large error and "
                    "leave them out",
                    counted(adjustment.iterations, "iteration")));
  for (std::size_t s = 0; s < quality.size(); ++s) {
    const auto& q = quality[s];
    if (q.board_rms_px > kMaxRmsPx)
      throw NotUsable(fmt::format(
          "sensor {}: the corners miss the board by {:.1f} px; check the pitch of the squares in x "
          "and y and the images with the largest error",
          q.name, q.board_rms_px));
    if (q.stripe_rms_px > kMaxRmsPx)
      throw NotUsable(
          fmt::format("sensor {}: the stripes miss the laser plane by {:.1f} px; check that each laser image "
                      "shows the same pose as its board image",
                      q.name, q.stripe_rms_px));
    const double tilt = spreads[s].tilt_deg;
    if (tilt < kMinTiltDeg && !camera_is_fixed(session, s))
      throw NotUsable(fmt::format(
          "sensor {}: the boards are tilted by {:.1f} degrees at most, so focal length and range can "
          "hardly be told apart; tilt the board by 20 to 45 degrees to different sides",
          q.name, tilt));
  }
  if (adjustment.covariance.size() == 0)
    throw NotUsable(fmt::format(
        "the views leave a direction of the rig open (singular normal matrix; lens model {}); tilt the board "
        "to more different sides, hold it at more different distances, or choose a leaner lens model "
        "(calibration.lens: brown4)",
        enum_name(adjustment.lenses.front())));
}

void refuse_uncertain_section(const JointAdjustment& adjustment, double shape_sigma_mm) {
  constexpr double kMaxShare = 5e-4;  // of the range: 0.25 mm at 500 mm
  double range = 0;
  for (const auto& pose : adjustment.state.first_from_board) range = std::max(range, pose.translation.norm());
  if (shape_sigma_mm > kMaxShare * range)
    throw NotUsable(
        fmt::format("the shape of a section would be uncertain by {:.2f} mm; take more views with the board "
                    "tilted by 20 to 45 degrees to different sides, over the whole measuring range",
                    shape_sigma_mm));
}

void refuse_parallel_lasers(const SessionViews& session, const std::vector<BoardSpread>& spreads) {
  constexpr double kMinAngleDeg = 10;  // below it the stripe is smeared over the board
  for (std::size_t s = 0; s < spreads.size(); ++s) {
    for (auto angles : spreads[s].laser_angles_deg) {
      if (angles.empty()) continue;
      const double median = upper_median(angles);
      if (median < kMinAngleDeg)
        throw NotUsable(
            fmt::format("sensor {}: the boards are nearly parallel to the laser plane ({:.1f} degrees in "
                        "half of the views), so "
                        "that the stripe has no clear line; turn the board towards the camera, 30 to 90 "
                        "degrees to the laser",
                        session.sensor_names[s], median));
    }
  }
}

void refuse_extrapolation(const SessionViews& session, const std::vector<BoardSpread>& spreads,
                          const CalibrationOptions& options) {
  constexpr double kMinCoverage = 0.12;     // of the image's diagonal
  constexpr double kMinRangeCovered = 0.6;  // of the measuring range that the session declares
  for (std::size_t s = 0; s < session.sensor_names.size(); ++s) {
    const auto& name = session.sensor_names[s];
    if (spreads[s].laser_angles_deg.empty()) continue;
    const double coverage = spreads[s].stripe_coverage;
    if (coverage < kMinCoverage)
      throw NotUsable(
          fmt::format("sensor {}: the boards' stripes cover {:.0f} % of the image's diagonal, all else would "
                      "be extrapolated; hold "
                      "the board in all of the measuring range",
                      name, 100 * coverage));
    const double range = options.range_far_mm - options.range_near_mm;
    if (!(range > 0)) continue;
    const DepthRange& seen = spreads[s].stripe_depths;
    const double covered =
        std::min(seen.far_mm, options.range_far_mm) - std::max(seen.near_mm, options.range_near_mm);
    if (covered < kMinRangeCovered * range)
      throw NotUsable(
          fmt::format("sensor {}: the boards' stripes lie between {:.0f} and {:.0f} mm of depth, the "
                      "measuring range is {:.0f} to "
                      "{:.0f} mm; hold the board nearer and farther too",
                      name, seen.near_mm, seen.far_mm, options.range_near_mm, options.range_far_mm));
  }
}

void refuse_oblong_pixels(const SessionViews& session, const RigState& state) {
  constexpr double kMaxAspect = 1.04;  // no machine vision camera; a sensor tilted by 10 degrees gives 1.015
  for (std::size_t s = 0; s < state.sensors.size(); ++s) {
    const auto& camera = state.sensors[s].camera;
    const double aspect = camera.fx / camera.fy;
    if (!session.given_cameras[s] && std::max(aspect, 1 / aspect) > kMaxAspect)
      throw NotUsable(
          fmt::format("sensor {}: pixels would be {:.2f} times as high as wide; check the pitch of the "
                      "squares in x and y, "
                      "and that the images are not scaled",
                      session.sensor_names[s], aspect));
  }
}

void refuse_folded_image(const SessionViews& session, const RigState& state) {
  for (std::size_t s = 0; s < state.sensors.size(); ++s)
    if (!invertible_over_image(state.sensors[s].camera))
      throw NotUsable(fmt::format(
          "sensor {}: the distortion found cannot be inverted over the whole image; bring the board into "
          "the image's corners, or choose a leaner lens model (calibration.lens)",
          session.sensor_names[s]));
}

std::vector<std::string> warnings_about(const SessionViews& session, const JointAdjustment& adjustment,
                                        const std::vector<ViewResidual>& views,
                                        const std::vector<BoardSpread>& spreads) {
  constexpr double kMuch = 0.2;  // share of a view's measurements left out
  constexpr double kLittleTiltDeg = 15, kLittleCoverage = 0.4;
  std::vector<std::string> warnings;
  for (const auto& view : views) {
    const int all = view.corners + view.stripe_points + view.left_out;
    if (view.left_out > kMuch * all)
      warnings.push_back(fmt::format("{}: {} of {} {} left out", view.image, view.left_out,
                                     counted(all, "measurement"),
                                     noun_of(view.left_out, "does not fit and was", "do not fit and were")));
  }
  for (std::size_t s = 0; s < session.sensor_names.size(); ++s) {
    const auto& name = session.sensor_names[s];
    const double tilt = spreads[s].tilt_deg;
    if (tilt < kLittleTiltDeg && !camera_is_fixed(session, s))
      warnings.push_back(fmt::format(
          "sensor {}: boards tilted by {:.0f} degrees at most; 20 to 45 make range and shape surer", name,
          tilt));
    const double coverage = spreads[s].stripe_coverage;
    if (coverage < kLittleCoverage && !spreads[s].laser_angles_deg.empty())
      warnings.push_back(fmt::format(
          "sensor {}: the boards' stripes cover {:.0f} % of the image's diagonal; beyond them the "
          "laser plane is extrapolated",
          name, 100 * coverage));
  }
  constexpr double kBowed_mm = 0.05;
  const Eigen::Vector2d& warp = adjustment.state.board_warp_mm;
  if (warp.cwiseAbs().maxCoeff() > kBowed_mm)
    warnings.push_back(
        fmt::format("the board is bowed by {:.2f} mm along x and {:.2f} mm along y; this is modelled, but a "
                    "flatter board gives a more reliable result",
                    warp.x(), warp.y()));
  if (session.motion == MotionType::kNone)
    warnings.push_back(
        "no motion was calibrated: x is the first laser plane's normal, not the direction of travel");
  return warnings;
}

std::vector<std::string> warnings_about(const CrossValidation& cross_validation) {
  constexpr double kMaxRatio = 2;
  if (!cross_validation.done || cross_validation.ratio() < kMaxRatio) return {};
  return {
      fmt::format("two halves of the views give sections that differ by {:.4f} mm, {:.1f} times what noise "
                  "explains: a lens "
                  "model too lean (calibration.lens), a board that is not rigid, or a laser that is not flat",
                  cross_validation.difference_mm, cross_validation.ratio())};
}

}  // namespace lightstripe
