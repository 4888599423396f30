// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/board/other_board.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "calib/board/board_map.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using CornerLine = std::vector<Vector2d>;

/// The corners along one side of a grid, and those of the next line inside.
struct Side {
  CornerLine edge, inner;
};

std::array<Side, 4> sides_of(const CornerLine& corners, int columns, int rows) {
  const auto line = [&](bool along_x, int at) {
    CornerLine places;
    for (int i = 0; i < (along_x ? columns : rows); ++i)
      places.push_back(corners[static_cast<std::size_t>(along_x ? at * columns + i : i * columns + at)]);
    return places;
  };
  return {{{line(true, 0), line(true, 1)},
           {line(true, rows - 1), line(true, rows - 2)},
           {line(false, 0), line(false, 1)},
           {line(false, columns - 1), line(false, columns - 2)}}};
}

bool in_picture(const cv::Mat& gray, const Vector2d& p) {
  return p.x() >= 0 && p.y() >= 0 && p.x() <= gray.cols - 1 && p.y() <= gray.rows - 1;
}

/// How much light and dark squares alternate along a side, grey levels, so many steps beyond its corners
/// (below 0: inside). Nothing where the picture ends before.
std::optional<double> alternation(const cv::Mat& gray, const Side& side, double steps) {
  // As many light as dark squares; a side of odd length leaves its last one out.
  const std::size_t squares = (side.edge.size() - 1) / 2 * 2;
  double sum = 0;
  for (std::size_t i = 0; i < squares; ++i) {
    const Vector2d middle = 0.5 * (side.edge[i] + side.edge[i + 1]);
    const Vector2d place = middle + steps * (middle - 0.5 * (side.inner[i] + side.inner[i + 1]));
    if (!in_picture(gray, place)) return std::nullopt;
    sum += (i % 2 == 0 ? 1 : -1) *
           static_cast<double>(gray.at<std::uint8_t>(cv::Point(static_cast<int>(std::lround(place.x())),
                                                               static_cast<int>(std::lround(place.y())))));
  }
  return 2 * std::abs(sum) / static_cast<double>(squares);
}

/// Whether no further line of corners is in view beyond this side.
bool ends(const cv::Mat& gray, const Side& side) {
  constexpr double kLeft = 0.5;     // of the alternation inside
  constexpr double kBeyond = 1.25;  // steps: in the squares of a further line, if there were one
  for (std::size_t i = 0; i < side.edge.size(); ++i)
    if (!in_picture(gray, 2 * side.edge[i] - side.inner[i])) return true;
  const auto inside = alternation(gray, side, -0.5), beyond = alternation(gray, side, kBeyond);
  return inside && beyond && *beyond < kLeft * *inside;
}

bool fits_in(int columns, int rows, const Target& target) {
  return columns <= target.columns && rows <= target.rows;
}

}  // namespace

bool is_other_board(const cv::Mat& gray, const CornerGrid& grid, const Target& target) {
  constexpr double kMissing = 0.02;  // of the corners
  const int c = grid.columns, r = grid.rows;
  if ((c == target.columns && r == target.rows) || (r == target.columns && c == target.rows)) return false;
  if (grid.count() < (1 - kMissing) * c * r || c < 3 || r < 3) return false;
  CornerLine corners;
  for (const auto& cell : grid.cells) corners.push_back(cell.value_or(Vector2d::Constant(std::nan(""))));
  Target seen;
  seen.columns = c, seen.rows = r, seen.pitch_x = seen.pitch_y = 1;
  const auto map = fit_board_map(corners, seen);
  if (!map || misfit(*map, seen) > kMaxMisfit) return false;
  if (!fits_in(c, r, target) && !fits_in(r, c, target)) return true;  // the target is a part of it at most
  const auto sides = sides_of(corners, c, r);
  return std::all_of(sides.begin(), sides.end(), [&](const Side& side) {
    const auto seen_all = [](const CornerLine& line) {
      return std::all_of(line.begin(), line.end(), [](const Vector2d& p) { return p.allFinite(); });
    };
    return seen_all(side.edge) && seen_all(side.inner) && ends(gray, side);
  });
}

bool has_squares_beyond(const cv::Mat& gray, const CornerLine& corners, const Target& target) {
  constexpr double kLeast = 0.2;    // of the alternation inside: a rim has none, a clamp may hide half
  constexpr double kBeyond = 0.25;  // steps: boards are sold with last squares of half the width
  const auto sides = sides_of(corners, target.columns, target.rows);
  return std::all_of(sides.begin(), sides.end(), [&](const Side& side) {
    const auto inside = alternation(gray, side, -0.5), beyond = alternation(gray, side, kBeyond);
    return !inside || !beyond || *beyond > kLeast * *inside;
  });
}

}  // namespace lightstripe
