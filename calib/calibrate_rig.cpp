// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/calibrate_rig.h"

#include <fmt/format.h>

#include <cmath>

#include "calib/initial_values.h"
#include "calib/joint_adjustment.h"
#include "calib/measurements.h"
#include "calib/rig_frame.h"
#include "calib/uncertainty.h"
#include "calib/verdict.h"
#include "core/error.h"

namespace lightstripe {
namespace {

void check(const CalibrationOptions& o) {
  const auto positive = [](const char* name, double value) {
    if (!(value > 0)) throw Error(name, fmt::format("{} is not positive", value), "give a positive number");
  };
  positive("corner_sigma_px", o.corner_sigma_px);
  positive("stripe_sigma_floor_px", o.stripe_sigma_floor_px);
  positive("robust_scale", o.robust_scale);
  positive("outlier_sigma", o.outlier_sigma);
  positive("max_iterations", o.max_iterations);
  if (o.distortion_terms != 0 && o.distortion_terms != 4 && o.distortion_terms != 5 &&
      o.distortion_terms != 8 && o.distortion_terms != 12)
    throw Error("distortion_terms", fmt::format("{} is not a model", o.distortion_terms),
                "choose 4, 5, 8, 12, or 0 for automatic");
}

void append(std::vector<std::string>& to, std::vector<std::string> from) {
  for (auto& text : from) to.push_back(std::move(text));
}

/// A k3 that the data do not show only disturbs the image beyond the boards.
bool needs_k3(const JointAdjustment& adjustment) {
  constexpr int kK3 = 8;  // place in the intrinsics block
  for (const auto& block : adjustment.globals) {
    if (block.kind != GlobalBlock::Kind::kIntrinsics || adjustment.covariance.size() == 0) continue;
    const auto& camera = adjustment.state.sensors[static_cast<std::size_t>(block.sensor)].camera;
    const int column = block.column + kK3;
    if (std::abs(camera.distortion[4]) > 3 * std::sqrt(adjustment.covariance(column, column))) return true;
  }
  return false;
}

/// The adjustment with the model that the options name, or that the data ask for; says which in `options`.
JointAdjustment adjusted(const InitialValues& start, CalibrationOptions& options) {
  if (options.distortion_terms != 0) return adjust_jointly(start.measurements, start.state, options);
  options.distortion_terms = 5;
  auto rich = adjust_jointly(start.measurements, start.state, options);
  if (needs_k3(rich)) return rich;
  options.distortion_terms = 4;
  auto lean = adjust_jointly(start.measurements, start.state, options);
  lean.iterations += rich.iterations;
  return lean;
}

/// The stages in their order; throws NotUsable with what was found so far in `result`.
void calibrate(const CalibrationObservations& observations, CalibrationOptions options,
               CalibrationResult& result) {
  const InitialValues start = initial_values(prepare_measurements(observations));
  const Measurements& measurements = start.measurements;
  auto& quality = result.rig.quality;
  quality.warnings = start.warnings;

  const JointAdjustment adjustment = adjusted(start, options);
  result.summary.iterations = adjustment.iterations;
  result.summary.views = view_residuals(measurements, adjustment.measurements);
  quality.sensors = sensor_quality(measurements, adjustment.measurements);
  refuse_bad_adjustment(measurements, adjustment, quality.sensors);

  Rig rig = rig_of(measurements, adjustment.state, observations.up);
  result.rig.sensors = std::move(rig.sensors);
  result.rig.motion = rig.motion;
  append(quality.warnings, warnings_about(measurements, adjustment, result.summary.views));
  quality.sigma = parameter_sigmas(measurements, adjustment, options);
  const auto section = section_uncertainty(measurements, adjustment, observations.up, options);
  quality.section_shape_sigma_mm = section.shape_mm;
  quality.section_absolute_sigma_mm = section.absolute_mm;
  refuse_uncertain_section(adjustment, section.shape_mm);
  refuse_folded_image(measurements, adjustment.state);
}

}  // namespace

CalibrationResult calibrate_rig(const CalibrationObservations& observations,
                                const CalibrationOptions& options) {
  check(options);
  CalibrationResult result;
  try {
    calibrate(observations, options, result);
    result.summary.usable = true;
    result.summary.message = "usable";
  } catch (const NotUsable& reason) {
    result.summary.message = reason.what();
  }
  return result;
}

}  // namespace lightstripe
