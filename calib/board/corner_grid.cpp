// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/board/corner_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

namespace lightstripe {
namespace {

using Eigen::Vector2d;

constexpr double kMinSpacingPx = 6;
const double kMaxTurn = std::cos(15 * std::numbers::pi / 180);  // of a link against the edge at its ends
constexpr int kNone = -1;

/// Directions of a corner: 0 and 1 along its edges, 2 and 3 against them.
Vector2d direction(const SaddleCorner& corner, int k) {
  return k < 2 ? corner.edges[static_cast<std::size_t>(k)]
               : Vector2d(-corner.edges[static_cast<std::size_t>(k - 2)]);
}

/// The direction of `corner` that comes nearest to `d`.
int nearest_direction(const SaddleCorner& corner, const Vector2d& d) {
  int best = 0;
  for (int k = 1; k < 4; ++k)
    if (direction(corner, k).dot(d) > direction(corner, best).dot(d)) best = k;
  return best;
}

/// The next corner along direction k: in line with it, of the other colours, the nearest.
int next_corner(const std::vector<SaddleCorner>& corners, int from, int k) {
  const auto& corner = corners[static_cast<std::size_t>(from)];
  const Vector2d along = direction(corner, k);
  double nearest = std::numeric_limits<double>::infinity();
  int best = kNone;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2d step = corners[i].position - corner.position;
    const double distance = step.norm();
    if (distance < kMinSpacingPx || distance >= nearest || step.dot(along) < kMaxTurn * distance) continue;
    const int back = nearest_direction(corners[i], -along);
    const bool other_colours = back % 2 != k % 2;
    if (!other_colours || direction(corners[i], back).dot(-step) < kMaxTurn * distance) continue;
    nearest = distance;
    best = static_cast<int>(i);
  }
  return best;
}

using Links = std::vector<std::array<int, 4>>;

/// Links that hold from both ends.
Links mutual_links(const std::vector<SaddleCorner>& corners) {
  Links next(corners.size()), mutual(corners.size(), {kNone, kNone, kNone, kNone});
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (int k = 0; k < 4; ++k)
      next[i][static_cast<std::size_t>(k)] = next_corner(corners, static_cast<int>(i), k);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (int k = 0; k < 4; ++k) {
      const int j = next[i][static_cast<std::size_t>(k)];
      if (j == kNone) continue;
      const int back = nearest_direction(corners[static_cast<std::size_t>(j)], -direction(corners[i], k));
      if (next[static_cast<std::size_t>(j)][static_cast<std::size_t>(back)] == static_cast<int>(i))
        mutual[i][static_cast<std::size_t>(k)] = j;
    }
  }
  return mutual;
}

/// A corner with its place in the grid; x_direction = which of its four directions is the grid's +x. +y is
/// the next one with growing angle, which makes the grid right-handed.
struct Placed {
  int corner, column, row, x_direction;
};

int positive_modulo_4(int k) { return ((k % 4) + 4) % 4; }

using Cell = std::array<int, 2>;

Cell operator+(const Cell& a, const Cell& b) { return {a[0] + b[0], a[1] + b[1]}; }
Cell operator-(const Cell& a) { return {-a[0], -a[1]}; }

/// A grid while it grows from a seed along the links.
class Walk {
 public:
  Walk(const std::vector<SaddleCorner>& corners, const Links& links) : corners_(corners), links_(links) {}

  std::vector<Placed> from(int seed, std::vector<bool>& visited) {
    static constexpr std::array<Cell, 4> kSteps{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    put({seed, 0, 0, 0}, visited);
    for (std::size_t i = 0; i < placed_.size(); ++i) {
      const Placed here = placed_[i];
      for (int step = 0; step < 4; ++step) {
        const int k = positive_modulo_4(here.x_direction + step);
        const int next = links_[static_cast<std::size_t>(here.corner)][static_cast<std::size_t>(k)];
        const Cell to = Cell{here.column, here.row} + kSteps[static_cast<std::size_t>(step)];
        if (next == kNone || visited[static_cast<std::size_t>(next)] || cells_.count(to)) continue;
        if (!continues(here, kSteps[static_cast<std::size_t>(step)], corner(next).position)) continue;
        const int same = nearest_direction(corner(next), direction(corner(here.corner), k));
        put({next, to[0], to[1], positive_modulo_4(same - step)}, visited);
      }
    }
    return std::move(placed_);
  }

 private:
  const SaddleCorner& corner(int i) const { return corners_[static_cast<std::size_t>(i)]; }

  void put(const Placed& placed, std::vector<bool>& visited) {
    visited[static_cast<std::size_t>(placed.corner)] = true;
    cells_[{placed.column, placed.row}] = corner(placed.corner).position;
    placed_.push_back(placed);
  }

  /// Whether the grid goes on at this position: one step as long as the last, or as the parallel one beside
  /// it. Where another pattern begins, on another plane, it does not.
  bool continues(const Placed& here, const Cell& step, const Vector2d& position) const {
    constexpr double kMaxDeviation = 0.25;  // of the step
    const Cell at{here.column, here.row}, beside{step[1], step[0]};
    const Vector2d from = cells_.at(at);
    std::optional<Vector2d> predicted;
    if (const auto back = cells_.find(at + -step); back != cells_.end()) predicted = from - back->second;
    for (const Cell& side : {beside, -beside}) {
      const auto start = cells_.find(at + side), end = cells_.find(at + side + step);
      if (!predicted && start != cells_.end() && end != cells_.end()) predicted = end->second - start->second;
    }
    return !predicted || (position - from - *predicted).norm() < kMaxDeviation * predicted->norm();
  }

  const std::vector<SaddleCorner>& corners_;
  const Links& links_;
  std::map<Cell, Vector2d> cells_;
  std::vector<Placed> placed_;
};

CornerGrid grid_of(const std::vector<SaddleCorner>& corners, const std::vector<Placed>& placed) {
  int left = 0, right = 0, top = 0, bottom = 0;
  for (const auto& p : placed) {
    left = std::min(left, p.column);
    right = std::max(right, p.column);
    top = std::min(top, p.row);
    bottom = std::max(bottom, p.row);
  }
  CornerGrid grid{right - left + 1, bottom - top + 1, {}};
  grid.cells.resize(grid.index(0, grid.rows));
  for (const auto& p : placed) {
    auto& cell = grid.at(p.column - left, p.row - top);
    if (!cell) cell = corners[static_cast<std::size_t>(p.corner)].position;
  }
  return grid;
}

int filled(const CornerGrid& grid, int left, int top, int columns, int rows) {
  return part(grid, left, top, columns, rows).count();
}

/// Takes off border rows and columns that are less than half full: single corners that happen to lie in line.
CornerGrid trimmed(CornerGrid grid) {
  while (grid.columns >= 3 && grid.rows >= 3) {
    const int c = grid.columns, r = grid.rows;
    if (2 * filled(grid, 0, 0, 1, r) < r)
      grid = part(grid, 1, 0, c - 1, r);
    else if (2 * filled(grid, c - 1, 0, 1, r) < r)
      grid = part(grid, 0, 0, c - 1, r);
    else if (2 * filled(grid, 0, 0, c, 1) < c)
      grid = part(grid, 0, 1, c, r - 1);
    else if (2 * filled(grid, 0, r - 1, c, 1) < c)
      grid = part(grid, 0, 0, c, r - 1);
    else
      break;
  }
  return grid;
}

}  // namespace

int CornerGrid::count() const {
  return static_cast<int>(
      std::count_if(cells.begin(), cells.end(), [](const auto& cell) { return cell.has_value(); }));
}

std::vector<CornerGrid> link_corners(const std::vector<SaddleCorner>& corners) {
  const Links links = mutual_links(corners);
  std::vector<bool> visited(corners.size(), false);
  std::vector<CornerGrid> grids;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (visited[i]) continue;
    const auto placed = Walk(corners, links).from(static_cast<int>(i), visited);
    if (placed.size() < 9) continue;
    CornerGrid grid = trimmed(grid_of(corners, placed));
    if (grid.columns >= 3 && grid.rows >= 3) grids.push_back(std::move(grid));
  }
  std::stable_sort(grids.begin(), grids.end(),
                   [](const auto& a, const auto& b) { return a.count() > b.count(); });
  return grids;
}

CornerGrid part(const CornerGrid& grid, int left, int top, int columns, int rows) {
  CornerGrid result{columns, rows, {}};
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) result.cells.push_back(grid.at(left + x, top + y));
  return result;
}

CornerGrid turned(const CornerGrid& grid) {
  CornerGrid result{grid.rows, grid.columns, {}};
  for (int y = 0; y < result.rows; ++y)
    for (int x = 0; x < result.columns; ++x) result.cells.push_back(grid.at(grid.columns - 1 - y, x));
  return result;
}

}  // namespace lightstripe
