// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Whether the larger part of what was seen agrees with the rig that was found.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "calib/adjust/session_views.h"
#include "calib/assess/verdict.h"
#include "core/counted.h"
#include "core/robust.h"

namespace lightstripe {
namespace {

struct Count {
  int used = 0, all = 0;
  double squares_px2 = 0;  // of those used

  void add(const Residual& residual) {
    ++all;
    if (!residual.used) return;
    ++used;
    squares_px2 += residual.residual_px.squaredNorm();
  }
  bool mostly_used() const { return 2 * used > all; }
};

/// Corners and stripes of every view; [view][0] the corners, [view][1 + plane] the stripe of that plane.
std::vector<std::map<int, Count>> count_by_view(const SessionViews& session,
                                                const std::vector<Residual>& residuals) {
  std::vector<std::map<int, Count>> counts(session.views.size());
  for (const auto& residual : residuals) counts[residual.view][1 + residual.plane].add(residual);
  return counts;
}

/// Stripes whose points mostly fit.
int fitting_stripes(const SessionViews& session, const std::vector<std::map<int, Count>>& counts,
                    std::size_t sensor, std::size_t plane) {
  int fitting = 0;
  for (std::size_t v = 0; v < counts.size(); ++v) {
    const auto stripe = counts[v].find(1 + static_cast<int>(plane));
    fitting += session.views[v].sensor == static_cast<int>(sensor) && stripe != counts[v].end() &&
               stripe->second.mostly_used();
  }
  return fitting;
}

/// Poses that more than one sensor shows, and how many of them a view contradicts.
void refuse_contradicting_sensors(const SessionViews& session,
                                  const std::vector<std::map<int, Count>>& counts) {
  std::map<int, std::pair<int, int>> by_pose;  // views, views that do not fit
  for (std::size_t v = 0; v < counts.size(); ++v) {
    if (session.views[v].pose < 0) continue;
    auto& [views, misfits] = by_pose[session.views[v].pose];
    ++views;
    const auto corners = counts[v].find(0);
    misfits += corners != counts[v].end() && !corners->second.mostly_used();
  }
  int common = 0, contradicting = 0;
  for (const auto& [pose, count] : by_pose) {
    if (count.first < 2) continue;
    ++common;
    contradicting += count.second > 0;
  }
  refuse_contradicting_poses(contradicting, common);
}

void refuse_contradicting_travel(const SessionViews& session,
                                 const std::vector<std::map<int, Count>>& counts) {
  constexpr double kMaxRmsPx = 2;
  Count travel;
  for (std::size_t v = 0; v < counts.size(); ++v) {
    const auto corners = counts[v].find(0);
    if (session.views[v].pose >= 0 || corners == counts[v].end()) continue;
    travel.used += corners->second.used;
    travel.all += corners->second.all;
    travel.squares_px2 += corners->second.squares_px2;
  }
  if (travel.all == 0) return;
  const double rms = travel.used > 0 ? std::sqrt(travel.squares_px2 / travel.used) : 0;
  if (rms > kMaxRmsPx || !travel.mostly_used())
    throw NotUsable(
        fmt::format("motion: the fixed board misses its places by {:.1f} px ({} of {} {}); check that "
                    "each picture stands in the table with its own position, and that the board is fixed",
                    rms, travel.used, counted(travel.all, "corner"), noun_of(travel.used, "fits", "fit")));
}

double median_depth_mm(const SessionViews& session, const RigState& state, std::size_t sensor) {
  const Eigen::Vector3d middle(session.target.middle().x(), session.target.middle().y(), 0);
  std::vector<double> depths;
  for (const auto& view : session.views)
    if (view.sensor == static_cast<int>(sensor) && view.pose >= 0)
      depths.push_back((state.sensors[sensor].cam_from_first *
                        (state.first_from_board[static_cast<std::size_t>(view.pose)] * middle))
                           .z());
  return upper_median(depths);
}

/// Heights that follow from the true ones by a linear rule lie in one plane too, a wrong one. In a wrong
/// order they do so roughly only: their lines miss the plane by half a percent of the heights' span and more,
/// those of blocks that are right to a tenth of a millimetre by far less.
void refuse_wrong_heights(const SessionViews& session, const JointAdjustment& adjustment) {
  constexpr double kMaxShare = 0.003;
  for (std::size_t s = 0; s < session.sensor_names.size(); ++s) {
    Count lines;
    double low = 0, high = 0;
    for (const auto& residual : adjustment.residuals) {
      const auto& view = session.views[residual.view];
      if (view.sensor != static_cast<int>(s) || !view.height_mm || residual.is_corner()) continue;
      low = lines.all == 0 ? *view.height_mm : std::min(low, *view.height_mm);
      high = lines.all == 0 ? *view.height_mm : std::max(high, *view.height_mm);
      lines.add(residual);
    }
    if (lines.used == 0) continue;
    const double rms_px = std::sqrt(lines.squares_px2 / lines.used);
    const double range = median_depth_mm(session, adjustment.state, s);
    const double rms_mm = rms_px * range / adjustment.state.sensors[s].camera.fx;
    if (rms_mm > kMaxShare * (high - low))
      throw NotUsable(
          fmt::format("sensor {}: the lines at the given heights miss one plane by {:.1f} px, about {:.2f} "
                      "mm; check that "
                      "heights.csv gives each picture its own height over the bed, in mm",
                      session.sensor_names[s], rms_px, rms_mm));
  }
}

/// The unit that would put the boards at a usual distance.
const char* likely_unit(double depth_mm) {
  if (depth_mm < 5) return "metres";
  return depth_mm < 30 ? "inches or centimetres" : depth_mm < 1000 ? "centimetres" : "tenths of a millimetre";
}

}  // namespace

std::vector<StripeAgreement> stripe_agreement(const SessionViews& session,
                                              const JointAdjustment& adjustment) {
  const auto counts = count_by_view(session, adjustment.residuals);
  std::vector<StripeAgreement> result;
  for (std::size_t s = 0; s < session.stripes_found.size(); ++s)
    for (std::size_t p = 0; p < session.stripes_found[s].size(); ++p)
      result.push_back({session.sensor_names[s], static_cast<int>(p), session.stripes_found[s][p],
                        fitting_stripes(session, counts, s, p)});
  return result;
}

void refuse_disagreement(const SessionViews& session, const JointAdjustment& adjustment) {
  const auto counts = count_by_view(session, adjustment.residuals);
  refuse_contradicting_sensors(session, counts);
  refuse_wrong_heights(session, adjustment);
  for (const auto& stripes : stripe_agreement(session, adjustment))
    if (2 * stripes.agreeing <= stripes.found)
      throw NotUsable(
          fmt::format("sensor {}: only {} of {} {} in one plane; check that each laser picture "
                      "shows the pose of "
                      "its board picture, and that the line is the laser's",
                      stripes.sensor, stripes.agreeing, counted(stripes.found, "stripe"),
                      noun_of(stripes.agreeing, "lies", "lie")));
  refuse_contradicting_travel(session, counts);
}

void refuse_wrong_unit(const SessionViews& session, const JointAdjustment& adjustment,
                       const CalibrationOptions& options) {
  constexpr double kNear_mm = 100, kFar_mm = 5000;
  if (session.motion == MotionType::kLinear || options.range_far_mm > 0) return;
  for (std::size_t s = 0; s < session.sensor_names.size(); ++s) {
    const double depth = median_depth_mm(session, adjustment.state, s);
    if (depth > kNear_mm && depth < kFar_mm) continue;
    throw NotUsable(fmt::format(
        "sensor {}: squares of {:.4g} mm put the boards {:.3g} mm from the camera; did you give {}? The "
        "target "
        "is described in mm; where it is right, declare the measuring range (calibration.range_near_mm, "
        "range_far_mm)",
        session.sensor_names[s], session.target.pitch_x, depth, likely_unit(depth)));
  }
}

void refuse_contradicting_halves(const CrossValidation& cross_validation, const JointAdjustment& adjustment) {
  constexpr double kMaxRatio = 5;
  constexpr double kMaxShare = 3e-3;  // of the range
  double range = 0;
  for (const auto& pose : adjustment.state.first_from_board) range = std::max(range, pose.translation.norm());
  if (!cross_validation.done || cross_validation.ratio() < kMaxRatio ||
      cross_validation.difference_mm < kMaxShare * range)
    return;
  throw NotUsable(
      fmt::format("two halves of the views give sections that differ by {:.2f} mm, {:.0f} times what noise "
                  "explains; look "
                  "for pictures of another setting, another board or another rig",
                  cross_validation.difference_mm, cross_validation.ratio()));
}

}  // namespace lightstripe
