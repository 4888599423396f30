// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/reference_shape.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

constexpr double kSpacingMm = 0.15;       // on R13: 2e-4 mm between chord and arc
constexpr double kMarginMm = 24.0;        // of the map around the outline
constexpr double kRunningDepthMm = 14.5;  // rail: below the corner R13's end in all outlines known
constexpr double kHeadDepthMm = 60.0;     // rail: the head is widest above this
constexpr double kFaceMarginMm = 0.5;     // rail: the lower corner is no face
constexpr double kRayStartMm = 400.0;

std::vector<Vector2d> polyline_of(const Outline& outline) {
  std::vector<Vector2d> vertices;
  for (const OutlineSample& point : sample(outline, kSpacingMm)) vertices.push_back(point.position);
  if (outline.closed()) vertices.push_back(vertices.front());
  return vertices;
}

}  // namespace

ReferenceShape::ReferenceShape(std::string name, ObjectKind kind, Outline outline)
    : name_(std::move(name)), kind_(kind), outline_(std::move(outline)), vertices_(polyline_of(outline_)) {
  find_landmarks();
  for (std::size_t i = 0; i + 1 < vertices_.size(); ++i)
    zones_.push_back(zone_at((vertices_[i] + vertices_[i + 1]) / 2));
  lengths_.assign(1, 0.0);
  for (std::size_t i = 1; i < vertices_.size(); ++i)
    lengths_.push_back(lengths_.back() + (vertices_[i] - vertices_[i - 1]).norm());
  fill_map();
}

double ReferenceShape::arc_length(const PolylineFoot& foot) const {
  const auto segment = static_cast<std::size_t>(foot.segment);
  return lengths_[segment] + (foot.position - vertices_[segment]).norm();
}

void ReferenceShape::find_landmarks() {
  const Vector2d* top = &vertices_[0];
  for (const Vector2d& p : vertices_)
    if (p.y() > top->y()) top = &p;
  top_v_ = top->y();
  top_u_ = kind_ == ObjectKind::kRail ? 0.0 : top->x();
  double widest = 0;
  bottom_v_ = top_v_ - kHeadDepthMm;
  for (const Vector2d& p : vertices_)
    if (p.y() > top_v_ - kHeadDepthMm && std::abs(p.x()) > widest)
      widest = std::abs(p.x()), bottom_v_ = p.y();
}

Zone ReferenceShape::zone_at(const Vector2d& p) const {
  if (kind_ == ObjectKind::kRail) {
    const bool right = p.x() > 0;
    if (p.y() > top_v_ - kRunningDepthMm) return Zone::kRunning;
    if (p.y() > bottom_v_ + kFaceMarginMm) return right ? Zone::kFaceRight : Zone::kFaceLeft;
    return right ? Zone::kBelowRight : Zone::kBelowLeft;
  }
  // Wheel: places in the standards' frame, back at u = -70.
  constexpr double kBackU = -69.5, kTipU = -53.0, kFieldU = 50.0;
  if (p.x() < kBackU && p.y() < top_v_ - 18) return Zone::kBack;
  if (p.x() < kTipU) return Zone::kFlangeTop;
  return p.x() > kFieldU ? Zone::kField : Zone::kRunning;
}

std::size_t ReferenceShape::cell_index(int column, int row) const {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
         static_cast<std::size_t>(column);
}

/// The neighbour's vertex, if it is nearer to this cell than this cell's own.
void ReferenceShape::propagate(int column, int row, int from_column, int from_row) {
  if (from_column < 0 || from_row < 0 || from_column >= columns_ || from_row >= rows_) return;
  const int vertex = nearest_[cell_index(from_column, from_row)];
  if (vertex < 0) return;
  const Vector2d middle = corner_ + kCellMm * Vector2d(column + 0.5, row + 0.5);
  const auto distance = static_cast<float>((vertices_[static_cast<std::size_t>(vertex)] - middle).norm());
  const std::size_t here = cell_index(column, row);
  if (distance < distances_[here]) distances_[here] = distance, nearest_[here] = vertex;
}

/// Nearest vertices by two passes over the neighbours (dead reckoning distance transform, Grevera 2004).
void ReferenceShape::fill_map() {
  Vector2d low = vertices_[0], high = vertices_[0];
  for (const Vector2d& p : vertices_) low = low.cwiseMin(p), high = high.cwiseMax(p);
  corner_ = low.array() - kMarginMm;
  columns_ = static_cast<int>((high.x() - corner_.x() + kMarginMm) / kCellMm) + 1;
  rows_ = static_cast<int>((high.y() - corner_.y() + kMarginMm) / kCellMm) + 1;
  const std::size_t cells = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  distances_.assign(cells, static_cast<float>(kFarthestMm));
  nearest_.assign(cells, -1);
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    const auto cell = static_cast<std::size_t>(cell_of(vertices_[i]));
    const auto columns = static_cast<std::size_t>(columns_), row = cell / columns, column = cell % columns;
    const Vector2d middle =
        corner_ + kCellMm * Vector2d(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
    const auto distance = static_cast<float>((vertices_[i] - middle).norm());
    if (nearest_[cell] < 0 || distance < distances_[cell])
      distances_[cell] = distance, nearest_[cell] = static_cast<int>(i);
  }
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column)
      for (const auto& [dc, dr] : {std::pair{-1, 0}, {-1, -1}, {0, -1}, {1, -1}})
        propagate(column, row, column + dc, row + dr);
    for (int column = columns_ - 1; column >= 0; --column) propagate(column, row, column + 1, row);
  }
  for (int row = rows_ - 1; row >= 0; --row) {
    for (int column = columns_ - 1; column >= 0; --column)
      for (const auto& [dc, dr] : {std::pair{1, 0}, {1, 1}, {0, 1}, {-1, 1}})
        propagate(column, row, column + dc, row + dr);
    for (int column = 0; column < columns_; ++column) propagate(column, row, column - 1, row);
  }
}

PolylineFoot ReferenceShape::foot_on(std::size_t segment, const Vector2d& p) const {
  const Vector2d &a = vertices_[segment], &b = vertices_[segment + 1];
  const Vector2d along = b - a;
  const double t = (p - a).dot(along) / along.squaredNorm();
  PolylineFoot foot;
  foot.position = a + std::clamp(t, 0.0, 1.0) * along;
  foot.normal = Vector2d(along.y(), -along.x()).normalized();
  foot.signed_distance = foot.normal.dot(p - foot.position);
  foot.segment = static_cast<int>(segment);
  const bool open = vertices_.front() != vertices_.back();
  foot.beyond_end = open && ((segment == 0 && t < 0) || (segment + 2 == vertices_.size() && t > 1));
  return foot;
}

std::optional<PolylineFoot> ReferenceShape::nearest(const Vector2d& p) const {
  const std::ptrdiff_t cell = cell_of(p);
  if (cell < 0 || nearest_[static_cast<std::size_t>(cell)] < 0) return std::nullopt;
  auto vertex = static_cast<std::size_t>(nearest_[static_cast<std::size_t>(cell)]);
  double best = (vertices_[vertex] - p).squaredNorm();
  for (const bool forwards : {true, false})
    while (forwards ? vertex + 1 < vertices_.size() : vertex > 0) {
      const std::size_t next = forwards ? vertex + 1 : vertex - 1;
      const double distance = (vertices_[next] - p).squaredNorm();
      if (distance >= best) break;
      best = distance, vertex = next;
    }
  const PolylineFoot before = foot_on(vertex > 0 ? vertex - 1 : vertex, p);
  const PolylineFoot after = foot_on(vertex + 1 < vertices_.size() ? vertex : vertex - 1, p);
  const PolylineFoot& foot =
      (before.position - p).squaredNorm() < (after.position - p).squaredNorm() ? before : after;
  if ((foot.position - p).squaredNorm() > kReachMm * kReachMm) return std::nullopt;
  return foot;
}

std::optional<double> ReferenceShape::surface_along(const Vector2d& origin, const Vector2d& outwards,
                                                    double across_mm) const {
  const Vector2d left(-outwards.y(), outwards.x());
  const Vector2d start = origin + across_mm * left + kRayStartMm * outwards;
  const auto hit = first_hit(outline_, start, -outwards, 0);
  if (!hit) return std::nullopt;
  return kRayStartMm - hit->s;
}

Outline outline_of_section(const Section& section) {
  constexpr double kSamePlaceMm = 1e-3;
  Outline chain;
  LIGHTSTRIPE_CHECK(section.size() >= 10, "a baseline needs ten points");
  Vector2d from = section.front().position;
  for (const SectionPoint& point : section) {
    if ((point.position - from).norm() < kSamePlaceMm) continue;
    chain.segments.push_back(line_segment(from, point.position));
    from = point.position;
  }
  return chain;
}

}  // namespace lightstripe
