// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/calibrate_rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "calib/adjust/joint_adjustment.h"
#include "calib/adjust/rig_frame.h"
#include "calib/adjust/session_views.h"
#include "calib/assess/board_spread.h"
#include "calib/assess/diagnosis.h"
#include "calib/assess/given_camera.h"
#include "calib/assess/uncertainty.h"
#include "calib/assess/verdict.h"
#include "calib/start/choose_lens.h"
#include "calib/start/initial_values.h"
#include "calib/start/start_tool.h"
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
  if (o.range_near_mm != 0 || o.range_far_mm != 0) {
    positive("range_near_mm", o.range_near_mm);
    positive("range_far_mm - range_near_mm", o.range_far_mm - o.range_near_mm);
  }
}

void append(std::vector<std::string>& to, std::vector<std::string> from) {
  for (auto& text : from) to.push_back(std::move(text));
}

/// The lens model of every sensor: given, or chosen.
std::vector<LensChoice> lens_choices(const InitialValues& start, const CalibrationOptions& options) {
  std::vector<LensChoice> choices;
  for (std::size_t s = 0; s < start.state.sensors.size(); ++s) {
    const auto& given = start.session.given_cameras[s];
    const bool fixed = given && given->fixed;
    if (options.lens != LensModel::kAuto || fixed) {
      choices.push_back({start.session.sensor_names[s], options.lens, {}});
    } else {
      choices.push_back(choose_lens(start, static_cast<int>(s), options));
    }
  }
  return choices;
}

std::vector<LensModel> models_of(const std::vector<LensChoice>& choices) {
  std::vector<LensModel> lenses;
  for (const auto& choice : choices) lenses.push_back(choice.lens);
  return lenses;
}

/// The measuring range: declared, or where boards showed stripes and half of that beyond on both sides.
std::array<double, 2> depth_range(const BoardSpread& spread, const CalibrationOptions& options) {
  if (options.range_far_mm > 0) return {options.range_near_mm, options.range_far_mm};
  const DepthRange& seen = spread.stripe_depths;
  const double beyond = 0.5 * (seen.far_mm - seen.near_mm);
  return {std::max(0.0, seen.near_mm - beyond), seen.far_mm + beyond};
}

/// Sensors and motion of `result.rig`; what was known before the adjustment stays.
void take_rig(const SessionViews& session, const JointAdjustment& adjustment,
              const std::vector<BoardSpread>& spreads, const Eigen::Vector3d& up,
              const CalibrationOptions& options, CalibrationResult& result) {
  Rig rig = rig_of(session, adjustment.state, up);
  result.rig.sensors = std::move(rig.sensors);
  for (std::size_t s = 0; s < result.rig.sensors.size(); ++s)
    result.rig.sensors[s].depth_range_mm = depth_range(spreads[s], options);
  result.rig.motion = rig.motion;
  if (const auto& tool = adjustment.state.tool)
    result.rig.tool_from_rig = tool->tool_from_first * result.rig.sensors.front().rig_from_camera.inverse();
}

/// With the tool's poses among the measurements.
JointAdjustment with_tool(const std::vector<ToolPose>& poses, const SessionViews& session,
                          const JointAdjustment& adjustment, const CalibrationOptions& options,
                          CalibrationResult& result) {
  const ToolPoses start = start_tool(poses, session, adjustment.state);
  ToolAdjustment with = adjust_with_tool(session, adjustment, start, options);
  append(result.rig.quality.warnings, std::move(with.left_out));
  return std::move(with.adjustment);
}

void summarise(const SessionViews& session, const JointAdjustment& adjustment, CalibrationResult& result) {
  result.summary.board_warp_mm = adjustment.state.board_warp_mm;
  result.summary.iterations = adjustment.iterations;
  result.summary.views = view_residuals(session, adjustment.residuals);
  result.summary.stripes = stripe_agreement(session, adjustment);
  result.rig.quality.sensors = sensor_quality(session, adjustment.residuals);
}

/// Predicted errors, cross-validation and what else the adjustment tells of itself.
void assess(const SessionViews& session, const JointAdjustment& adjustment,
            const std::vector<BoardSpread>& spreads, const Eigen::Vector3d& up,
            const CalibrationOptions& options, CalibrationResult& result) {
  auto& quality = result.rig.quality;
  append(quality.warnings, warnings_about(session, adjustment, result.summary.views, spreads));
  quality.sigma = parameter_sigmas(session, adjustment);
  const SectionErrors errors = section_errors(session, adjustment, up);
  const auto section = section_uncertainty(errors, adjustment.covariance);
  quality.section_shape_sigma_mm = section.shape_mm;
  quality.section_absolute_sigma_mm = section.absolute_mm;
  quality.section_bends = section_bends(session, adjustment, errors, up);
  const CalibrationDiagnosis& diagnosis =
      result.diagnosis.emplace(diagnose(session, adjustment, spreads, errors, up, options));
  if (diagnosis.cross_validation.done) quality.cross_validation_ratio = diagnosis.cross_validation.ratio();
  quality.weakest = diagnosis.weakest;
  append(quality.warnings, warnings_about(diagnosis.cross_validation));
}

/// The stages in their order; throws NotUsable with what was found so far in `result`.
void calibrate(const CalibrationObservations& observations, const CalibrationOptions& options,
               CalibrationResult& result) {
  const InitialValues start = initial_values(prepare_session_views(observations));
  const SessionViews& session = start.session;
  result.rig.quality.warnings = start.warnings;

  result.summary.lenses = lens_choices(start, options);
  JointAdjustment adjustment =
      adjust_jointly(session, start.state, models_of(result.summary.lenses), options);
  summarise(session, adjustment, result);
  std::vector<BoardSpread> spreads = board_spreads(session, adjustment);
  refuse_wrong_camera(session, adjustment, result.rig.quality.sensors, options);
  refuse_bad_adjustment(session, adjustment, result.rig.quality.sensors, spreads);
  refuse_disagreement(session, adjustment);
  refuse_wrong_unit(session, adjustment, options);

  if (observations.tool_poses) {
    adjustment = with_tool(*observations.tool_poses, session, adjustment, options, result);
    summarise(session, adjustment, result);
    spreads = board_spreads(session, adjustment);
  }
  take_rig(session, adjustment, spreads, observations.up, options, result);
  assess(session, adjustment, spreads, observations.up, options, result);
  refuse_parallel_lasers(session, spreads);
  refuse_extrapolation(session, spreads, options);
  refuse_uncertain_section(adjustment, result.rig.quality.section_shape_sigma_mm);
  refuse_oblong_pixels(session, adjustment.state);
  refuse_folded_image(session, adjustment.state);
  refuse_contradicting_halves(result.diagnosis->cross_validation, adjustment);
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
