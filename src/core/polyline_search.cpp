// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "core/polyline_search.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

constexpr double kOnVertex = 1e-12;  // mm; nearer than this, the direction to a vertex is rounding noise

Vector2d foot_on_segment(const Vector2d& a, const Vector2d& b, const Vector2d& query) {
  const Vector2d along = b - a;
  const double length_squared = along.squaredNorm();
  if (!(length_squared > 0)) return a;
  const double t = (query - a).dot(along) / length_squared;
  if (!(t > 0)) return a;
  if (!(t < 1)) return b;  // not a + 1 * along: the vertex itself, to the bit
  return a + t * along;
}

}  // namespace

PolylineSearch::PolylineSearch(std::span<const Vector2d> vertices, double reach_mm)
    : vertices_(vertices.begin(), vertices.end()), reach_mm_(reach_mm) {
  constexpr int kMaxCellsPerSide = 512;
  LIGHTSTRIPE_CHECK(vertices.size() >= 2, "a polyline has two vertices or more");
  LIGHTSTRIPE_CHECK(reach_mm > 0, "reach must be positive");
  Vector2d low = vertices_[0], high = vertices_[0];
  for (const Vector2d& p : vertices_) {
    LIGHTSTRIPE_CHECK(p.allFinite(), "a polyline's vertices must be finite");
    low = low.cwiseMin(p), high = high.cwiseMax(p);
  }
  const double extent = (high - low).maxCoeff();
  LIGHTSTRIPE_CHECK(extent > 0, "a polyline must not be a single point");
  // About one segment a cell along the line: then a query near the line looks at a handful of segments.
  cell_mm_ = std::max(extent / kMaxCellsPerSide, 2 * extent / static_cast<double>(vertices_.size()));
  corner_ = low;
  const Cell last = cell_of(high);
  columns_ = last.column + 1, rows_ = last.row + 1;
  cells_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  for (int i = 0; i + 1 < static_cast<int>(vertices_.size()); ++i) insert(i);
}

PolylineSearch::Cell PolylineSearch::cell_of(const Vector2d& p) const {
  const Vector2d cell = ((p - corner_) / cell_mm_).array().floor();
  return {static_cast<int>(cell.x()), static_cast<int>(cell.y())};
}

std::size_t PolylineSearch::index_of(int column, int row) const {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
         static_cast<std::size_t>(column);
}

void PolylineSearch::insert(int segment) {
  // Every cell that the segment's bounding box touches: more than it passes, never fewer.
  const auto s = static_cast<std::size_t>(segment);
  const Cell a = cell_of(vertices_[s].cwiseMin(vertices_[s + 1]));
  const Cell b = cell_of(vertices_[s].cwiseMax(vertices_[s + 1]));
  for (int row = a.row; row <= b.row; ++row)
    for (int column = a.column; column <= b.column; ++column)
      cells_[index_of(column, row)].push_back(segment);
}

void PolylineSearch::search_cell(const Vector2d& query, int column, int row, double& best_squared,
                                 int& best) const {
  if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return;
  for (int segment : cells_[index_of(column, row)]) {
    const auto s = static_cast<std::size_t>(segment);
    const double squared = (query - foot_on_segment(vertices_[s], vertices_[s + 1], query)).squaredNorm();
    if (squared < best_squared || (squared == best_squared && segment < best))
      best_squared = squared, best = segment;
  }
}

void PolylineSearch::search_ring(const Vector2d& query, const Cell& centre, int ring, double& best_squared,
                                 int& best) const {
  for (int row = centre.row - ring; row <= centre.row + ring; ++row) {
    const bool whole_row = std::abs(row - centre.row) == ring;
    const int step = whole_row || ring == 0 ? 1 : 2 * ring;
    for (int column = centre.column - ring; column <= centre.column + ring; column += step)
      search_cell(query, column, row, best_squared, best);
  }
}

PolylineFoot PolylineSearch::foot_on(int segment, const Vector2d& query) const {
  const Vector2d &a = vertices_[static_cast<std::size_t>(segment)],
                 &b = vertices_[static_cast<std::size_t>(segment) + 1];
  PolylineFoot foot{foot_on_segment(a, b, query), Vector2d::Zero(), 0, segment, false};
  const Vector2d along = (b - a).normalized(), off = query - foot.position;
  const double distance = off.norm();
  foot.normal = Vector2d(along.y(), -along.x());
  if ((foot.position == a || foot.position == b) && distance > kOnVertex) {
    foot.normal = off / distance;
    const bool open = vertices_.front() != vertices_.back();
    const bool at_end = foot.position == vertices_.front() || foot.position == vertices_.back();
    foot.beyond_end = open && at_end && std::abs(along.dot(off)) > kOnVertex;
  }
  foot.signed_distance = foot.normal.dot(off);
  return foot;
}

std::optional<PolylineFoot> PolylineSearch::nearest(const Vector2d& query) const {
  if (!query.allFinite()) return std::nullopt;
  const Vector2d extent(columns_ * cell_mm_, rows_ * cell_mm_);
  const Vector2d outside = (corner_ - query).cwiseMax(query - corner_ - extent).cwiseMax(0.0);
  if (outside.norm() > reach_mm_) return std::nullopt;
  const Cell centre = cell_of(query);
  double best_squared = reach_mm_ * reach_mm_;
  const int none = static_cast<int>(vertices_.size());
  int best = none;
  // Whatever lies in ring k or beyond is at least (k - 1) cells away.
  for (int ring = 0; (ring - 1) * cell_mm_ <= std::sqrt(best_squared); ++ring)
    search_ring(query, centre, ring, best_squared, best);
  if (best == none) return std::nullopt;
  return foot_on(best, query);
}

}  // namespace lightstripe
