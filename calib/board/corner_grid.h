// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Saddle corners -> regular grids: neighbours along common edges, with colours that alternate.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "calib/board/saddle_corners.h"

namespace lightstripe {

/// A grid of corners, row by row; cells where no corner was found are empty. Right-handed in the image (x
/// cross y into the picture). Border rows and columns are at least half full.
struct CornerGrid {
  int columns = 0, rows = 0;
  std::vector<std::optional<Eigen::Vector2d>> cells;

  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
  std::optional<Eigen::Vector2d>& at(int column, int row) { return cells[index(column, row)]; }
  const std::optional<Eigen::Vector2d>& at(int column, int row) const { return cells[index(column, row)]; }
  int count() const;
};

/// Grids of at least 3 x 3 corners, that with the most corners first.
std::vector<CornerGrid> link_corners(const std::vector<SaddleCorner>& corners);

/// The `columns` x `rows` cells from (left, top) on, which have to lie inside.
CornerGrid part(const CornerGrid& grid, int left, int top, int columns, int rows);

/// The same grid with columns and rows exchanged, still right-handed.
CornerGrid turned(const CornerGrid& grid);

}  // namespace lightstripe
