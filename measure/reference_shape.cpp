// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/reference_shape.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

constexpr double kSpacingMm = 0.15;       // on R13: 2e-4 mm between chord and arc
constexpr double kCellMm = 1.0;           // of the distance grid
constexpr double kMarginMm = 24.0;        // of the distance grid around the outline
constexpr double kFarthestMm = 20.0;      // distances are cut off here
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
    : name_(std::move(name)),
      kind_(kind),
      outline_(std::move(outline)),
      vertices_(polyline_of(outline_)),
      search_(vertices_, kReachMm) {
  find_landmarks();
  for (std::size_t i = 0; i + 1 < vertices_.size(); ++i)
    zones_.push_back(zone_at((vertices_[i] + vertices_[i + 1]) / 2));
  fill_distances();
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

void ReferenceShape::fill_distances() {
  Vector2d low = vertices_[0], high = vertices_[0];
  for (const Vector2d& p : vertices_) low = low.cwiseMin(p), high = high.cwiseMax(p);
  corner_ = low.array() - kMarginMm;
  columns_ = static_cast<int>((high.x() - corner_.x() + kMarginMm) / kCellMm) + 2;
  rows_ = static_cast<int>((high.y() - corner_.y() + kMarginMm) / kCellMm) + 2;
  const auto at = [&](int column, int row) -> float& {
    return distances_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                      static_cast<std::size_t>(column)];
  };
  distances_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_),
                    static_cast<float>(kFarthestMm));
  for (const Vector2d& p : vertices_) {
    const Vector2d cell = (p - corner_) / kCellMm;
    at(static_cast<int>(cell.x() + 0.5), static_cast<int>(cell.y() + 0.5)) = 0;
  }
  // Distances by two passes over the neighbours (chamfer).
  const auto relax = [&](int column, int row, int dc, int dr) {
    const int c = column + dc, r = row + dr;
    if (c < 0 || r < 0 || c >= columns_ || r >= rows_) return;
    const double step = kCellMm * (dc != 0 && dr != 0 ? 1.41421356 : 1.0);
    at(column, row) = std::min(at(column, row), static_cast<float>(at(c, r) + step));
  };
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column)
      relax(column, row, -1, 0), relax(column, row, 0, -1), relax(column, row, -1, -1),
          relax(column, row, 1, -1);
  for (int row = rows_ - 1; row >= 0; --row)
    for (int column = columns_ - 1; column >= 0; --column)
      relax(column, row, 1, 0), relax(column, row, 0, 1), relax(column, row, 1, 1), relax(column, row, -1, 1);
}

double ReferenceShape::coarse_distance(const Vector2d& p) const {
  const double column = (p.x() - corner_.x()) / kCellMm + 0.5, row = (p.y() - corner_.y()) / kCellMm + 0.5;
  if (!(column >= 0 && row >= 0 && column < columns_ && row < rows_)) return kFarthestMm;
  return static_cast<double>(distances_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                                        static_cast<std::size_t>(column)]);
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
