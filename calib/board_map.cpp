// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/board_map.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <cmath>
#include <opencv2/calib3d.hpp>

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
  const Eigen::Index n = static_cast<Eigen::Index>(corners.size()), terms = num_monomials(corners.size());
  if (terms > 0) {
    Eigen::MatrixXd A(n, terms), b(n, 2);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Vector2d& q = corners[static_cast<std::size_t>(i)];
      A.row(i) = monomials((q - map.centre) / map.scale_px).head(terms).transpose();
      b.row(i) = (target.corner(static_cast<int>(i)) - map(q)).transpose();
    }
    map.remainder.leftCols(terms) = A.colPivHouseholderQr().solve(b).transpose();
  }
  double sum = 0;
  for (Eigen::Index i = 0; i < n; ++i)
    sum += (target.corner(static_cast<int>(i)) - map(corners[static_cast<std::size_t>(i)])).squaredNorm();
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
  std::vector<cv::Point2d> pixels, board;
  BoardMap map;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2d p = target.corner(static_cast<int>(i));
    pixels.emplace_back(corners[i].x(), corners[i].y());
    board.emplace_back(p.x(), p.y());
    map.centre += corners[i] / static_cast<double>(corners.size());
  }
  const cv::Mat H = cv::findHomography(pixels, board);
  if (H.empty()) return std::nullopt;
  for (int i = 0; i < 9; ++i) map.board_from_pixel(i / 3, i % 3) = H.at<double>(i / 3, i % 3);
  map.scale_px = std::max(1.0, (corners.back() - corners.front()).norm());
  fit_remainder(map, corners, target);
  return map;
}

}  // namespace lightstripe
