// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Observations -> measurements: poses matched by name, stripes thinned to independent points; symmetries of
// the board.
#pragma once

#include <vector>

#include "calib/adjust/rig_state.h"

namespace lightstripe {

/// Poses in the order of their first appearance. Throws NotUsable where a sensor has too few views or no
/// stripe.
SessionViews prepare_session_views(const CalibrationObservations& observations);

/// Throws NotUsable where that many of the poses common to several sensors, half or more, are not where the
/// first of them sees them: pictures of different moments were paired.
void refuse_contradicting_poses(int contradicting, int common);

/// Every k-th point, so that neighbours are at least as far apart as extraction's kernel averages along the
/// line: its centre points are correlated over 2 sqrt(pi) sigma = 1.02 widths. Bridged points are left out.
std::vector<StripePoint> independent_points(const std::vector<StripePoint>& points);

/// The orders in which the same corners may be listed without contradicting the board's look: the identity,
/// half a turn where colours agree, quarter turns of a square board. order[i] = old index of the corner that
/// becomes i.
std::vector<std::vector<int>> corner_orders(const Target& target);

/// What the k-th order does to the board frame: board_from_turned. A board seen as T in the listed order is
/// seen as T * board_turn(target, k) when its corners are relisted by corner_orders(target)[k].
Rigid3 board_turn(const Target& target, std::size_t k);

std::vector<Eigen::Vector2d> relisted(const std::vector<Eigen::Vector2d>& corners,
                                      const std::vector<int>& order);

}  // namespace lightstripe
