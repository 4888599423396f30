// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "calib/start/height_lines.h"
#include "calib/start/initial_values.h"
#include "calib/start/pairing_faults.h"
#include "calib/start/stripe_planes.h"
#include "core/counted.h"

namespace lightstripe {
namespace {

constexpr std::size_t kMinAgreeing = 3;  // two lines may share a plane by chance

std::string plane_name(const InitialValues& values, int sensor, std::size_t plane) {
  const auto& s = values.session.sensor_names[static_cast<std::size_t>(sensor)];
  return plane == 0 ? fmt::format("sensor {}", s) : fmt::format("sensor {}, laser plane {}", s, plane + 1);
}

void refuse_degenerate(const PlaneFit& fit, const std::vector<const StripeInSpace*>& stripes,
                       const std::string& name) {
  constexpr double kMinSpread = 0.03;  // of the longer extent
  constexpr double kMinOffset = 0.01;  // of the range: below it the stripe does not move with the range
  if (fit.spread.y() < kMinSpread * fit.spread.x() || fit.spread.y() < 3 * fit.rms || !fit.determined())
    throw NotUsable(
        fmt::format("{}: all stripes lie on one line in space, which fixes no laser plane; hold the board at "
                    "different distances and tilt it across the stripe",
                    name));
  double range = 0;
  for (const auto* stripe : stripes)
    range += stripe->points.front().norm() / static_cast<double>(stripes.size());
  if (fit.plane.offset < kMinOffset * range)
    throw NotUsable(
        fmt::format("{}: the camera lies in the laser plane ({:.1f} mm beside it), the stripe does not move "
                    "with the range; set the laser farther from the camera",
                    name, fit.plane.offset));
}

/// Says what share of the stripes lies in one plane, and what may have happened.
void refuse_minority(const InitialValues& values, const std::vector<StripeInSpace>& stripes,
                     std::size_t agreeing, const std::string& name) {
  const bool enough = agreeing >= std::min(kMinAgreeing, stripes.size()) && 2 * agreeing > stripes.size();
  const bool clearly = enough && 4 * agreeing >= 3 * stripes.size();
  if (clearly) return;
  const std::string guess = guess_pairing(values, stripes, agreeing);
  if (enough && guess.empty()) return;  // a better explanation is needed to doubt the larger part
  throw NotUsable(fmt::format(
      "{}: {} of {} {}; {}", name, agreeing == 0 ? "none" : fmt::format("only {}", agreeing), stripes.size(),
      noun_of(agreeing, "stripes lies in one plane", "stripes lie in one plane"),
      guess.empty() ? "check that each laser picture shows the pose of its board picture, and that the line "
                      "is the laser's"
                    : guess));
}

/// Drops the stripes that do not count, and says why.
void leave_out(InitialValues& values, const std::vector<StripeInSpace>& stripes,
               const std::vector<const StripeInSpace*>& kept, const Plane& laser, std::size_t plane) {
  for (const auto& stripe : stripes) {
    auto& view = values.session.views[stripe.view];
    const bool agrees = std::find(kept.begin(), kept.end(), &stripe) != kept.end();
    const bool crosses = stripe_line(board_plane(values.cam_from_board[stripe.view]), laser).has_value();
    if (agrees && crosses) continue;
    values.warnings.push_back(
        agrees ? fmt::format("{}: stripe left out, the board is parallel to the laser plane", view.image)
               : fmt::format("{}: stripe left out, it lies {:.1f} mm off the laser plane of the others{}",
                             view.image, distance_to(laser, stripe), guess_partner(values, stripe, laser)));
    view.stripes[plane].clear();
  }
}

Plane start_plane(InitialValues& values, int sensor, std::size_t plane) {
  const auto name = plane_name(values, sensor, plane);
  const auto stripes = stripes_in_space(values, sensor, plane);
  if (stripes.empty())
    throw NotUsable(
        fmt::format("{}: the stripe was found on 0 boards only: no laser line on any board; boards for the "
                    "camera alone are asked for by laser: none",
                    name));
  if (stripes.size() < 2)
    throw NotUsable(
        fmt::format("{}: the stripe was found on {} only; at least 2 are needed, better all of them", name,
                    counted(stripes.size(), "board")));
  values.session.stripes_found[static_cast<std::size_t>(sensor)].push_back(static_cast<int>(stripes.size()));
  const auto kept = stripes_in_one_plane(stripes);
  refuse_minority(values, stripes, kept.size(), name);
  const PlaneFit fit = plane_through(kept);
  refuse_degenerate(fit, kept, name);
  refuse_flipped_pictures(values, stripes, kept, fit.plane, name);
  for (auto& view : values.session.views)
    if (view.sensor == sensor && view.pose >= 0 && view.stripes[plane].size() < kMinStripePoints)
      view.stripes[plane].clear();
  leave_out(values, stripes, kept, fit.plane, plane);
  return fit.plane;
}

}  // namespace

void start_laser_planes(InitialValues& values) {
  values.session.stripes_found.assign(values.state.sensors.size(), {});
  for (std::size_t sensor = 0; sensor < values.state.sensors.size(); ++sensor) {
    std::size_t planes = 0;
    for (const auto& view : values.session.views)
      if (view.sensor == static_cast<int>(sensor)) planes = std::max(planes, view.stripes.size());
    if (planes == 1) choose_height_lines(values, static_cast<int>(sensor));
    if (planes > 1) label_stripes(values, static_cast<int>(sensor), planes);
    for (std::size_t plane = 0; plane < planes; ++plane)
      values.state.sensors[sensor].laser_planes.push_back(
          start_plane(values, static_cast<int>(sensor), plane));
  }
}

}  // namespace lightstripe
