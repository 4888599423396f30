// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Where a target's print changes its brightness: near such edges a stripe's centre is shifted.
#pragma once

#include <Eigen/Core>
#include <array>

#include "core/board.h"

namespace lightstripe {

/// An edge of the print next to a place on the board.
struct PrintEdge {
  double distance_mm = 0;
  Eigen::Vector2d across = Eigen::Vector2d::UnitX();  ///< unit, board frame
};

/// The nearest edges across x and across y (checkerboards, markers), or the nearest circle's rim twice.
std::array<PrintEdge, 2> nearest_edges(const Target& target, const Eigen::Vector2d& p_board);

/// Whether the place lies on the pattern or on its plain rim (Target::rim), and not within a marker, whose
/// bits shift a stripe's centre.
bool carries_stripes(const Target& target, const Eigen::Vector2d& p_board);

/// Whether the place lies beside the pattern.
bool on_rim(const Target& target, const Eigen::Vector2d& p_board);

}  // namespace lightstripe
