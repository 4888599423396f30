// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// How well the corners and stripe points fit, by view and by sensor.
#include <algorithm>
#include <cmath>

#include "calib/assess/verdict.h"

namespace lightstripe {
namespace {

/// Sums of squares of corners and stripe points.
struct Sums {
  double corners_px2 = 0, stripe_px2 = 0;
  int corners = 0, stripe_points = 0, left_out = 0;

  void add(const Residual& residual) {
    if (!residual.used) {
      ++left_out;
      return;
    }
    const double squared = residual.residual_px.squaredNorm();
    (residual.is_corner() ? corners_px2 : stripe_px2) += squared;
    ++(residual.is_corner() ? corners : stripe_points);
  }
  double board_rms() const { return corners ? std::sqrt(corners_px2 / corners) : 0; }
  double stripe_rms() const { return stripe_points ? std::sqrt(stripe_px2 / stripe_points) : 0; }
};

std::vector<Sums> sums_by_view(const SessionViews& session, const std::vector<Residual>& list) {
  std::vector<Sums> sums(session.views.size());
  for (const auto& residual : list) sums[residual.view].add(residual);
  return sums;
}

}  // namespace

std::vector<ViewResidual> view_residuals(const SessionViews& session, const std::vector<Residual>& list) {
  const auto sums = sums_by_view(session, list);
  std::vector<ViewResidual> result;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const auto& view = session.views[i];
    result.push_back({session.sensor_names[static_cast<std::size_t>(view.sensor)], view.image,
                      sums[i].board_rms(), sums[i].stripe_rms(), sums[i].corners, sums[i].stripe_points,
                      sums[i].left_out});
  }
  return result;
}

std::vector<SensorQuality> sensor_quality(const SessionViews& session, const std::vector<Residual>& list) {
  std::vector<Sums> sums(session.sensor_names.size());
  for (const auto& residual : list)
    sums[static_cast<std::size_t>(session.views[residual.view].sensor)].add(residual);
  std::vector<SensorQuality> result;
  for (std::size_t s = 0; s < sums.size(); ++s) {
    SensorQuality quality{session.sensor_names[s], sums[s].board_rms(), sums[s].stripe_rms(), 0, 0};
    for (const auto& view : session.views) {
      if (view.sensor != static_cast<int>(s)) continue;
      quality.board_views += !view.height_mm;
      quality.stripe_views +=
          std::any_of(view.stripes.begin(), view.stripes.end(), [](const auto& x) { return !x.empty(); });
    }
    result.push_back(quality);
  }
  return result;
}

}  // namespace lightstripe
