// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/board/laser_look.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "calib/board/board_edges.h"
#include "calib/observations.h"
#include "core/linear_algebra.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

/// Grey level as a linear function of the place, fitted to the middles of like squares.
struct LevelMap {
  Eigen::Vector3d terms = Eigen::Vector3d::Zero();
  double at(const Vector2d& p) const { return terms.dot(p.homogeneous()); }
};

std::optional<LevelMap> fit_levels(const std::vector<Vector2d>& places, const std::vector<double>& levels) {
  if (places.size() < 4) return std::nullopt;
  Eigen::MatrixXd A(static_cast<Eigen::Index>(places.size()), 3);
  Eigen::VectorXd b(A.rows());
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    A.row(i) = places[static_cast<std::size_t>(i)].homogeneous().transpose();
    b(i) = levels[static_cast<std::size_t>(i)];
  }
  LevelMap map;
  map.terms = solve_least_squares(A, b);
  return map;
}

double grey_at(ImageView8 image, const Vector2d& p) {
  const int x = std::clamp(static_cast<int>(std::lround(p.x())), 0, image.width - 1);
  const int y = std::clamp(static_cast<int>(std::lround(p.y())), 0, image.height - 1);
  return image(x, y);
}

/// Levels of the squares like the first one ([0]) and of the others, those next to the line left out.
std::array<std::optional<LevelMap>, 2> square_levels(ImageView8 image, const std::vector<StripePoint>& line,
                                                     const std::vector<Vector2d>& corners,
                                                     const Target& target) {
  std::array<std::vector<Vector2d>, 2> places;
  std::array<std::vector<double>, 2> levels;
  const auto columns = static_cast<std::size_t>(target.columns);
  for (int y = 0; y + 1 < target.rows; ++y) {
    for (int x = 0; x + 1 < target.columns; ++x) {
      const auto i = static_cast<std::size_t>(y) * columns + static_cast<std::size_t>(x);
      const Vector2d middle =
          0.25 * (corners[i] + corners[i + 1] + corners[i + columns] + corners[i + columns + 1]);
      const double side = (corners[i + 1] - corners[i]).norm();
      const bool lit = std::any_of(line.begin(), line.end(), [&](const StripePoint& p) {
        return (Vector2d(p.x, p.y) - middle).norm() < 0.5 * side + p.width;
      });
      if (lit || !is_seen(middle)) continue;
      const auto parity = static_cast<std::size_t>((x + y) % 2);
      places[parity].push_back(middle);
      levels[parity].push_back(grey_at(image, middle));
    }
  }
  return {fit_levels(places[0], levels[0]), fit_levels(places[1], levels[1])};
}

bool along_the_border(const std::vector<Vector2d>& on_board, const Target& target) {
  constexpr double kParallel = 0.1;  // sine of the angle to the pattern's side
  const Vector2d along = (on_board.back() - on_board.front()).normalized();
  const bool beside = std::all_of(on_board.begin(), on_board.end(), [&](const Vector2d& p) {
    return p.x() < 0 || p.y() < 0 || p.x() > target.extent().x() || p.y() > target.extent().y();
  });
  return beside && std::min(std::abs(along.x()), std::abs(along.y())) < kParallel;
}

/// Share of the line's points that are brighter than the squares that they lie on; nothing where the squares'
/// levels cannot be told.
std::optional<double> share_brighter(ImageView8 image, const std::vector<StripePoint>& line,
                                     const std::vector<Vector2d>& on_board,
                                     const std::vector<Vector2d>& corners, const Target& target) {
  constexpr double kBrighter = 0.05;  // of the contrast between the squares
  constexpr double kClipped = 250;
  const auto levels = square_levels(image, line, corners, target);
  if (!levels[0] || !levels[1]) return std::nullopt;
  int brighter = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vector2d pixel(line[i].x, line[i].y);
    const double a = levels[0]->at(pixel), b = levels[1]->at(pixel), grey = grey_at(image, pixel);
    const auto square = static_cast<long>(std::floor(on_board[i].x() / target.pitch_x) +
                                          std::floor(on_board[i].y() / target.pitch_y));
    const double ground = on_rim(target, on_board[i]) ? std::max(a, b) : square % 2 == 0 ? a : b;
    brighter += grey > ground + kBrighter * std::abs(a - b) || grey >= kClipped;
  }
  return static_cast<double>(brighter) / static_cast<double>(line.size());
}

}  // namespace

std::string no_laser_because(ImageView8 image, const std::vector<StripePoint>& line,
                             const std::vector<Vector2d>& corners, const BoardMap& map,
                             const Target& target) {
  constexpr double kMost = 0.5;  // of the points
  if (line.size() < 2) return "";
  std::vector<Vector2d> on_board;
  for (const auto& p : line) on_board.push_back(map({p.x, p.y}));
  if (along_the_border(on_board, target))
    return "the line runs along the pattern's border: it looks like the board's rim, not like a laser";
  if (target.type != TargetType::kCheckerboard) return "";
  const auto share = share_brighter(image, line, on_board, corners, target);
  if (share && *share < kMost)
    return "the line is no brighter than the board's own squares: it looks like print, not like a laser";
  return "";
}

}  // namespace lightstripe
