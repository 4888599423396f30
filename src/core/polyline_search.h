// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The nearest point of a polyline, fast for thousands of queries.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

namespace lightstripe {

struct PolylineFoot {
  Eigen::Vector2d position;  ///< the nearest point of the polyline
  Eigen::Vector2d normal;    ///< unit; square to the segment, or towards the query where a vertex is nearest
  double signed_distance;    ///< normal . (query - position)
  int segment;
  bool beyond_end;  ///< past the end of an open polyline: the normal says nothing about the shape
};

/// Segments of a polyline in a uniform grid of square cells.
class PolylineSearch {
 public:
  /// At least two vertices, not all in one place. `reach_mm`: how far a query may be from the polyline.
  PolylineSearch(std::span<const Eigen::Vector2d> vertices, double reach_mm);

  /// The foot of the perpendicular (or the nearest vertex); nothing beyond the reach.
  std::optional<PolylineFoot> nearest(const Eigen::Vector2d& query) const;

 private:
  struct Cell {
    int column, row;
  };
  Cell cell_of(const Eigen::Vector2d& p) const;
  std::size_t index_of(int column, int row) const;
  void insert(int segment);
  /// The nearest segment among those of one ring of cells, if it beats `best_squared`.
  void search_ring(const Eigen::Vector2d& query, const Cell& centre, int ring, double& best_squared,
                   int& best) const;
  void search_cell(const Eigen::Vector2d& query, int column, int row, double& best_squared, int& best) const;
  PolylineFoot foot_on(int segment, const Eigen::Vector2d& query) const;

  std::vector<Eigen::Vector2d> vertices_;
  std::vector<std::vector<int>> cells_;  // row by row
  Eigen::Vector2d corner_;               // of cell (0, 0)
  double reach_mm_ = 0, cell_mm_ = 0;
  int columns_ = 0, rows_ = 0;
};

}  // namespace lightstripe
