// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "calib/adjust/session_views.h"
#include "calib/start/initial_values.h"

namespace lightstripe {
namespace {

/// How far apart two transforms put points at a typical working distance, mm.
double difference_mm(const Rigid3& a, const Rigid3& b) {
  const Rigid3 step = a.inverse() * b;
  return rotation_angle(step.rotation) * a.translation.norm() + step.translation.norm();
}

/// b_from_a by every common pose, for every way to list b's corners.
std::vector<std::vector<Rigid3>> candidates(const InitialValues& values, int a, int b) {
  const auto& views = values.session.views;
  const std::size_t turns = corner_orders(values.session.target).size();
  std::map<int, std::size_t> seen_by_a;  // pose -> view
  for (std::size_t i = 0; i < views.size(); ++i)
    if (views[i].sensor == a && views[i].pose >= 0 && !views[i].height_mm) seen_by_a[views[i].pose] = i;
  std::vector<std::vector<Rigid3>> result;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto in_a = seen_by_a.find(views[i].pose);
    if (views[i].sensor != b || views[i].pose < 0 || views[i].height_mm || in_a == seen_by_a.end()) continue;
    result.emplace_back();
    for (std::size_t k = 0; k < turns; ++k)
      result.back().push_back(values.cam_from_board[i] * board_turn(values.session.target, k) *
                              values.cam_from_board[in_a->second].inverse());
  }
  return result;
}

/// The candidate that the other poses agree with best: the sum of their smallest differences is least.
Rigid3 medoid(const std::vector<std::vector<Rigid3>>& poses) {
  double best_sum = std::numeric_limits<double>::infinity();
  Rigid3 best;
  for (const auto& pose : poses) {
    for (const auto& candidate : pose) {
      double sum = 0;
      for (const auto& other : poses) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const auto& turned : other) nearest = std::min(nearest, difference_mm(candidate, turned));
        sum += nearest;
      }
      // With a single common pose all sums are zero: then the smaller rotation is the likelier.
      const bool tie = std::abs(sum - best_sum) < 1e-9;
      if (tie ? rotation_angle(candidate.rotation) < rotation_angle(best.rotation) : sum < best_sum) {
        best_sum = sum;
        best = candidate;
      }
    }
  }
  return best;
}

/// Grows a tree from the first sensor, always by the pair with the most common poses (Prim).
void chain_sensors(InitialValues& values) {
  const int n = static_cast<int>(values.state.sensors.size());
  std::vector<bool> linked(static_cast<std::size_t>(n), false);
  linked[0] = true;
  for (int round = 1; round < n; ++round) {
    int from = -1, to = -1;
    std::vector<std::vector<Rigid3>> best;
    for (int a = 0; a < n; ++a) {
      for (int b = 0; b < n; ++b) {
        if (!linked[static_cast<std::size_t>(a)] || linked[static_cast<std::size_t>(b)]) continue;
        auto pair = candidates(values, a, b);
        if (pair.size() <= best.size()) continue;
        best = std::move(pair);
        from = a;
        to = b;
      }
    }
    if (to < 0) return;  // the caller names who is left
    const auto& names = values.session.sensor_names;
    if (best.size() == 1)
      values.warnings.push_back(fmt::format("sensors {} and {} share one pose of the board only",
                                            names[static_cast<std::size_t>(from)],
                                            names[static_cast<std::size_t>(to)]));
    linked[static_cast<std::size_t>(to)] = true;
    values.state.sensors[static_cast<std::size_t>(to)].cam_from_first =
        medoid(best) * values.state.sensors[static_cast<std::size_t>(from)].cam_from_first;
  }
}

void refuse_unlinked(const InitialValues& values) {
  const auto& names = values.session.sensor_names;
  const int n = static_cast<int>(names.size());
  std::vector<bool> linked(names.size(), false);
  linked[0] = true;
  for (int round = 1; round < n; ++round)
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < n; ++b)
        if (linked[static_cast<std::size_t>(a)] && !candidates(values, a, b).empty())
          linked[static_cast<std::size_t>(b)] = true;
  std::string alone;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (!linked[i]) alone += (alone.empty() ? "" : ", ") + names[i];
  if (!alone.empty())
    throw NotUsable(
        fmt::format("no board pose links sensor {} with {}; add poses of the board that both see at the same "
                    "time, with the same text in their file names",
                    alone, names[0]));
}

/// The way to list the corners of view i that brings it nearest to the pose known so far.
std::size_t nearest_turn(const InitialValues& values, std::size_t i, const Rigid3& first_from_board,
                         double* difference) {
  const auto& view = values.session.views[i];
  const auto& sensor = values.state.sensors[static_cast<std::size_t>(view.sensor)];
  const std::size_t turns = corner_orders(values.session.target).size();
  std::size_t best = 0;
  *difference = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < turns; ++k) {
    const Rigid3 turned = values.cam_from_board[i] * board_turn(values.session.target, k);
    const double d = difference_mm(turned, sensor.cam_from_first * first_from_board);
    if (d < *difference) {
      *difference = d;
      best = k;
    }
  }
  return best;
}

/// Poses in the first frame; corners relisted where a view shows the board turned; views that contradict left
/// out.
void gather_poses(InitialValues& values) {
  constexpr double kMaxDifference =
      0.08;  // of the range, between two sensors' opinions of one pose; noise gives 0.5 %
  auto& m = values.session;
  const auto orders = corner_orders(m.target);
  std::vector<std::optional<Rigid3>> poses(m.poses.size());
  std::vector<bool> keep(m.views.size(), true);
  int compared = 0, contradicting = 0;
  for (std::size_t i = 0; i < m.views.size(); ++i) {
    auto& view = m.views[i];
    if (view.pose < 0 || view.height_mm) continue;
    auto& pose = poses[static_cast<std::size_t>(view.pose)];
    if (!pose) {
      const auto& sensor = values.state.sensors[static_cast<std::size_t>(view.sensor)];
      pose = sensor.cam_from_first.inverse() * values.cam_from_board[i];
      continue;
    }
    double difference = 0;
    const std::size_t k = nearest_turn(values, i, *pose, &difference);
    ++compared;
    if (difference > kMaxDifference * values.cam_from_board[i].translation.norm()) {
      keep[i] = false;
      ++contradicting;
      values.warnings.push_back(
          fmt::format("{}: left out, another sensor sees the board of pose {} {:.0f} mm away; are "
                      "these images of the same moment?",
                      view.image, m.poses[static_cast<std::size_t>(view.pose)], difference));
    } else if (k > 0) {
      view.corners = relisted(view.corners, orders[k]);
      values.cam_from_board[i] = values.cam_from_board[i] * board_turn(m.target, k);
    }
  }
  refuse_contradicting_poses(contradicting, compared);
  keep_views(values, keep);
  for (const auto& pose : poses) values.state.first_from_board.push_back(pose.value_or(Rigid3{}));
}

}  // namespace

void link_sensors(InitialValues& values) {
  refuse_unlinked(values);
  chain_sensors(values);
  gather_poses(values);
}

}  // namespace lightstripe
