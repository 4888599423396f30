// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/assess/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "calib/assess/board_spread.h"

namespace lightstripe {
namespace {

/// Sums of squares of corners and stripe points.
struct Sums {
  double corners_px2 = 0, stripe_px2 = 0;
  int corners = 0, stripe_points = 0, left_out = 0;

  void add(const Residual& measurement) {
    if (!measurement.used) {
      ++left_out;
      return;
    }
    const double squared = measurement.residual_px.squaredNorm();
    (measurement.is_corner() ? corners_px2 : stripe_px2) += squared;
    ++(measurement.is_corner() ? corners : stripe_points);
  }
  double board_rms() const { return corners ? std::sqrt(corners_px2 / corners) : 0; }
  double stripe_rms() const { return stripe_points ? std::sqrt(stripe_px2 / stripe_points) : 0; }
};

std::vector<Sums> sums_by_view(const SessionViews& measurements, const std::vector<Residual>& list) {
  std::vector<Sums> sums(measurements.views.size());
  for (const auto& measurement : list) sums[measurement.view].add(measurement);
  return sums;
}

}  // namespace

std::vector<ViewResidual> view_residuals(const SessionViews& measurements,
                                         const std::vector<Residual>& list) {
  const auto sums = sums_by_view(measurements, list);
  std::vector<ViewResidual> result;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const auto& view = measurements.views[i];
    result.push_back({measurements.sensor_names[static_cast<std::size_t>(view.sensor)], view.image,
                      sums[i].board_rms(), sums[i].stripe_rms(), sums[i].corners, sums[i].stripe_points,
                      sums[i].left_out});
  }
  return result;
}

std::vector<SensorQuality> sensor_quality(const SessionViews& measurements,
                                          const std::vector<Residual>& list) {
  std::vector<Sums> sums(measurements.sensor_names.size());
  for (const auto& measurement : list)
    sums[static_cast<std::size_t>(measurements.views[measurement.view].sensor)].add(measurement);
  std::vector<SensorQuality> result;
  for (std::size_t s = 0; s < sums.size(); ++s) {
    SensorQuality quality{measurements.sensor_names[s], sums[s].board_rms(), sums[s].stripe_rms(), 0, 0};
    for (const auto& view : measurements.views) {
      if (view.sensor != static_cast<int>(s)) continue;
      ++quality.board_views;
      quality.stripe_views +=
          std::any_of(view.stripes.begin(), view.stripes.end(), [](const auto& x) { return !x.empty(); });
    }
    result.push_back(quality);
  }
  return result;
}

void refuse_bad_adjustment(const SessionViews& measurements, const JointAdjustment& adjustment,
                           const std::vector<SensorQuality>& quality) {
  constexpr double kMaxRmsPx = 2;    // beyond it board or stripes are not what the session says
  constexpr double kMinTiltDeg = 5;  // below it range errors exceed a millimetre at half a metre
  if (!adjustment.converged)
    throw NotUsable(
        fmt::format("the adjustment did not converge in {} iterations; look for views with a large error and "
                    "leave them out",
                    adjustment.iterations));
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
    const double tilt = tilt_spread_deg(measurements, adjustment.state, static_cast<int>(s));
    if (tilt < kMinTiltDeg)
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

void refuse_parallel_lasers(const SessionViews& measurements, const RigState& state) {
  constexpr double kMinAngleDeg = 10;  // below it the stripe is smeared over the board
  for (std::size_t s = 0; s < state.sensors.size(); ++s) {
    for (std::size_t p = 0; p < state.sensors[s].laser_planes.size(); ++p) {
      auto angles = laser_angles_deg(measurements, state, static_cast<int>(s), p);
      if (angles.empty()) continue;
      std::nth_element(angles.begin(), angles.begin() + static_cast<std::ptrdiff_t>(angles.size() / 2),
                       angles.end());
      const double median = angles[angles.size() / 2];
      if (median < kMinAngleDeg)
        throw NotUsable(
            fmt::format("sensor {}: the boards are nearly parallel to the laser plane ({:.1f} degrees in "
                        "half of the views), so "
                        "that the stripe has no clear line; turn the board towards the camera, 30 to 90 "
                        "degrees to the laser",
                        measurements.sensor_names[s], median));
    }
  }
}

void refuse_extrapolation(const SessionViews& measurements, const JointAdjustment& adjustment,
                          const CalibrationOptions& options) {
  constexpr double kMinCoverage = 0.12;     // of the image's diagonal
  constexpr double kMinRangeCovered = 0.6;  // of the measuring range that the session declares
  for (std::size_t s = 0; s < measurements.sensor_names.size(); ++s) {
    const int sensor = static_cast<int>(s);
    const auto& name = measurements.sensor_names[s];
    if (adjustment.state.sensors[s].laser_planes.empty()) continue;
    const double coverage = stripe_coverage(measurements, adjustment.measurements, sensor);
    if (coverage < kMinCoverage)
      throw NotUsable(
          fmt::format("sensor {}: the boards' stripes cover {:.0f} % of the image's diagonal, all else would "
                      "be extrapolated; hold "
                      "the board in all of the measuring range",
                      name, 100 * coverage));
    const double range = options.range_far_mm - options.range_near_mm;
    if (!(range > 0)) continue;
    const auto seen = stripe_depths(measurements, adjustment.state, adjustment.measurements, sensor);
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

void refuse_oblong_pixels(const SessionViews& measurements, const RigState& state) {
  constexpr double kMaxAspect = 1.04;  // no machine vision camera; a sensor tilted by 10 degrees gives 1.015
  for (std::size_t s = 0; s < state.sensors.size(); ++s) {
    const auto& camera = state.sensors[s].camera;
    const double aspect = camera.fx / camera.fy;
    if (!measurements.given_cameras[s] && std::max(aspect, 1 / aspect) > kMaxAspect)
      throw NotUsable(
          fmt::format("sensor {}: pixels would be {:.2f} times as high as wide; check the pitch of the "
                      "squares in x and y, "
                      "and that the images are not scaled",
                      measurements.sensor_names[s], aspect));
  }
}

void refuse_folded_image(const SessionViews& measurements, const RigState& state) {
  for (std::size_t s = 0; s < state.sensors.size(); ++s)
    if (!invertible_over_image(state.sensors[s].camera))
      throw NotUsable(fmt::format(
          "sensor {}: the distortion found cannot be inverted over the whole image; bring the board into "
          "the image's corners, or choose a leaner lens model (calibration.lens)",
          measurements.sensor_names[s]));
}

std::vector<std::string> warnings_about(const SessionViews& measurements, const JointAdjustment& adjustment,
                                        const std::vector<ViewResidual>& views) {
  constexpr double kMuch = 0.2;  // share of a view's measurements left out
  constexpr double kLittleTiltDeg = 15, kLittleCoverage = 0.4;
  std::vector<std::string> warnings;
  for (const auto& view : views) {
    const int all = view.corners + view.stripe_points + view.left_out;
    if (view.left_out > kMuch * all)
      warnings.push_back(fmt::format("{}: {} of {} measurements do not fit and were left out", view.image,
                                     view.left_out, all));
  }
  for (std::size_t s = 0; s < measurements.sensor_names.size(); ++s) {
    const auto& name = measurements.sensor_names[s];
    const double tilt = tilt_spread_deg(measurements, adjustment.state, static_cast<int>(s));
    if (tilt < kLittleTiltDeg)
      warnings.push_back(fmt::format(
          "sensor {}: boards tilted by {:.0f} degrees at most; 20 to 45 make range and shape surer", name,
          tilt));
    const double coverage = stripe_coverage(measurements, adjustment.measurements, static_cast<int>(s));
    if (coverage < kLittleCoverage)
      warnings.push_back(fmt::format(
          "sensor {}: the boards' stripes cover {:.0f} % of the image's diagonal; beyond them the "
          "laser plane is extrapolated",
          name, 100 * coverage));
  }
  constexpr double kBowed_mm = 0.05;
  const Eigen::Vector2d& warp = adjustment.state.board_warp_mm;
  if (warp.cwiseAbs().maxCoeff() > kBowed_mm)
    warnings.push_back(
        fmt::format("the board is bowed by {:.2f} mm along x and {:.2f} mm along y; that is taken into "
                    "account, a flatter board is surer",
                    warp.x(), warp.y()));
  if (measurements.motion == MotionType::kNone)
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
