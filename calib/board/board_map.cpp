// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/board/board_map.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <cmath>

#include "calib/board/board_homography.h"
#include "calib/observations.h"

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

void fit_remainder(BoardMap& map, const std::vector<Vector2d>& corners, const Target& target) {
  std::vector<int> seen;
  for (int i = 0; i < target.num_corners(); ++i)
    if (is_seen(corners[static_cast<std::size_t>(i)])) seen.push_back(i);
  const Eigen::Index n = static_cast<Eigen::Index>(seen.size()), terms = num_monomials(seen.size());
  const auto corner = [&](Eigen::Index k) { return target.corner(seen[static_cast<std::size_t>(k)]); };
  const auto pixel = [&](Eigen::Index k) {
    return corners[static_cast<std::size_t>(seen[static_cast<std::size_t>(k)])];
  };
  if (terms > 0) {
    Eigen::MatrixXd A(n, terms), b(n, 2);
    for (Eigen::Index k = 0; k < n; ++k) {
      A.row(k) = monomials((pixel(k) - map.centre) / map.scale_px).head(terms).transpose();
      b.row(k) = (corner(k) - map(pixel(k))).transpose();
    }
    map.remainder.leftCols(terms) = A.colPivHouseholderQr().solve(b).transpose();
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

std::optional<BoardMap> fit_board_map(const std::vector<Vector2d>& corners, const Target& target) {
  std::vector<Vector2d> pixels, board;
  BoardMap map;
  Vector2d low = Vector2d::Constant(1e9), high = -low;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (!is_seen(corners[i])) continue;
    const Vector2d p = target.corner(static_cast<int>(i));
    low = low.cwiseMin(corners[i]);
    high = high.cwiseMax(corners[i]);
    pixels.push_back(corners[i]);
    board.push_back(p);
    map.centre += corners[i];
  }
  if (pixels.size() < 4) return std::nullopt;
  map.centre /= static_cast<double>(pixels.size());
  const auto H = find_homography(pixels, board);
  if (!H) return std::nullopt;
  map.board_from_pixel = *H;
  map.scale_px = std::max(1.0, (high - low).norm());
  fit_remainder(map, corners, target);
  return map;
}

}  // namespace lightstripe
