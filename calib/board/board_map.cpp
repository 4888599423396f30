// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/board/board_map.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "calib/board/board_homography.h"
#include "calib/board/seen_corners.h"
#include "core/linear_algebra.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

/// Monomials up to the third degree.
Eigen::Matrix<double, 10, 1> monomials(const Vector2d& p) {
  const double x = p.x(), y = p.y();
  Eigen::Matrix<double, 10, 1> m;
  m << 1, x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y, y * y * y;
  return m;
}

/// As many of them as the corners determine well.
Eigen::Index num_monomials(std::size_t corners) { return corners >= 40 ? 10 : corners >= 20 ? 6 : 0; }

void fit_remainder(BoardMap& map, const SeenCorners& seen) {
  const Eigen::Index n = static_cast<Eigen::Index>(seen.pixels.size()),
                     terms = num_monomials(seen.pixels.size());
  const auto corner = [&](Eigen::Index k) { return seen.board[static_cast<std::size_t>(k)]; };
  const auto pixel = [&](Eigen::Index k) { return seen.pixels[static_cast<std::size_t>(k)]; };
  if (terms > 0) {
    Eigen::MatrixXd A(n, terms), b(n, 2);
    for (Eigen::Index k = 0; k < n; ++k) {
      A.row(k) = monomials((pixel(k) - map.centre) / map.scale_px).head(terms).transpose();
      b.row(k) = (corner(k) - map(pixel(k))).transpose();
    }
    map.remainder.leftCols(terms) = solve_least_squares(A, b).transpose();
  }
  double sum = 0;
  for (Eigen::Index k = 0; k < n; ++k) sum += (corner(k) - map(pixel(k))).squaredNorm();
  map.rms_mm = std::sqrt(sum / static_cast<double>(n));
}

}  // namespace

Vector2d BoardMap::operator()(const Vector2d& pixel) const {
  const Eigen::Vector3d p = board_from_pixel * pixel.homogeneous();
  return p.hnormalized() + remainder * monomials((pixel - centre) / scale_px);
}

Eigen::Matrix2d BoardMap::derivative(const Vector2d& pixel) const {
  constexpr double kStepPx = 0.5;
  Eigen::Matrix2d J;
  for (int i = 0; i < 2; ++i) {
    const Vector2d step = kStepPx * Vector2d::Unit(i);
    J.col(i) = ((*this)(pixel + step) - (*this)(pixel - step)) / (2 * kStepPx);
  }
  return J;
}

double misfit(const BoardMap& map, const Target& target) {
  return map.rms_mm / std::min(target.pitch_x, target.pitch_y);
}

std::optional<BoardMap> fit_board_map(const std::vector<Vector2d>& corners, const Target& target) {
  const SeenCorners seen = seen_corners(corners, target);
  if (seen.pixels.size() < 4) return std::nullopt;
  BoardMap map;
  Vector2d low = Vector2d::Constant(1e9), high = -low;
  for (const Vector2d& pixel : seen.pixels) {
    low = low.cwiseMin(pixel);
    high = high.cwiseMax(pixel);
    map.centre += pixel;
  }
  map.centre /= static_cast<double>(seen.pixels.size());
  const auto H = find_homography(seen.pixels, seen.board);
  if (!H) return std::nullopt;
  map.board_from_pixel = *H;
  map.scale_px = std::max(1.0, (high - low).norm());
  fit_remainder(map, seen);
  return map;
}

}  // namespace lightstripe
