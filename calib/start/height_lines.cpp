// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/start/height_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "calib/adjust/session_views.h"
#include "core/counted.h"

namespace lightstripe {
namespace {

using Eigen::Vector3d;

constexpr double kFits = 0.0015;     // of the range: a line in the laser plane
constexpr double kMinOffset = 0.02;  // of the range: nearer to the camera lies the plane of its own rays

/// A line of a picture, taken as lying at the picture's height.
struct BedLine {
  std::size_t view = 0, line = 0;
  StripeInSpace in_space;
};

std::vector<BedLine> candidates(const InitialValues& values, int sensor) {
  std::vector<BedLine> result;
  for (std::size_t v = 0; v < values.session.views.size(); ++v) {
    const auto& view = values.session.views[v];
    if (view.sensor != sensor || !view.height_mm) continue;
    const auto& camera = values.state.sensors[static_cast<std::size_t>(sensor)].camera;
    const Plane top = board_plane(values.cam_from_board[v]);
    for (std::size_t k = 0; k < view.lines.size(); ++k) {
      BedLine candidate{v, k, {v, 0, {}}};
      for (const auto& point : independent_points(view.lines[k])) {
        const auto ray = unproject(camera, {point.x, point.y});
        const auto p = ray ? intersect(top, Vector3d::Zero(), *ray) : std::nullopt;
        if (p) candidate.in_space.points.push_back(*p);
      }
      if (candidate.in_space.points.size() >= kMinStripePoints) result.push_back(std::move(candidate));
    }
  }
  return result;
}

/// For each picture the candidate nearest to the plane, where it fits.
struct Choice {
  std::vector<const BedLine*> chosen;
  double sum_mm = 0;
};

Choice nearest_to(const Plane& plane, const std::vector<BedLine>& all) {
  Choice choice;
  for (std::size_t i = 0; i < all.size();) {
    const BedLine* best = nullptr;
    double least = kFits * all[i].in_space.points.front().norm();
    const std::size_t view = all[i].view;
    for (; i < all.size() && all[i].view == view; ++i) {
      const double distance = distance_to(plane, all[i].in_space);
      if (distance >= least) continue;
      least = distance;
      best = &all[i];
    }
    if (!best) continue;
    choice.chosen.push_back(best);
    choice.sum_mm += least;
  }
  return choice;
}

bool is_laser_plane(const PlaneFit& fit, const BedLine& like) {
  return fit.determined() && std::abs(fit.plane.offset) > kMinOffset * like.in_space.points.front().norm();
}

/// Pictures with candidates, and warnings about those of which none was chosen.
void judge_choice(InitialValues& values, int sensor, const std::vector<BedLine>& all, const Choice& choice) {
  std::set<std::size_t> shown, chosen;
  for (const BedLine& candidate : all) shown.insert(candidate.view);
  for (const BedLine* candidate : choice.chosen) chosen.insert(candidate->view);
  if (5 * chosen.size() < 4 * shown.size())
    throw NotUsable(
        fmt::format("sensor {}: only {} of {} show a line at their height in one plane; check that "
                    "heights.csv gives each "
                    "picture its own height over the bed, in mm",
                    values.session.sensor_names[static_cast<std::size_t>(sensor)], chosen.size(),
                    counted(shown.size(), "picture of heights", "pictures of heights")));
  for (const std::size_t v : shown)
    if (!chosen.contains(v))
      values.warnings.push_back(
          fmt::format("{}: left out, no line of it lies at {:g} mm in the laser plane of the others",
                      values.session.views[v].image, *values.session.views[v].height_mm));
}

}  // namespace

void choose_height_lines(InitialValues& values, int sensor) {
  const auto all = candidates(values, sensor);
  Choice best;
  for (std::size_t a = 0; a < all.size(); ++a) {
    for (std::size_t b = a + 1; b < all.size(); ++b) {
      const auto &view_a = values.session.views[all[a].view], &view_b = values.session.views[all[b].view];
      if (std::abs(*view_a.height_mm - *view_b.height_mm) < 1e-9) continue;
      const PlaneFit fit = plane_through({&all[a].in_space, &all[b].in_space});
      if (!is_laser_plane(fit, all[a])) continue;
      Choice choice = nearest_to(fit.plane, all);
      const bool better = choice.chosen.size() > best.chosen.size() ||
                          (choice.chosen.size() == best.chosen.size() && choice.sum_mm < best.sum_mm);
      if (better) best = std::move(choice);
    }
  }
  judge_choice(values, sensor, all, best);
  for (const BedLine* line : best.chosen) {
    auto& view = values.session.views[line->view];
    view.stripes[0] = independent_points(view.lines[line->line]);
  }
}

}  // namespace lightstripe
