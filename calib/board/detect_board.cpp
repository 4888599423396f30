// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <optional>

#include "calib/board/board_map.h"
#include "calib/board/board_reasons.h"
#include "calib/board/corner_grid.h"
#include "calib/board/detect_charuco.h"
#include "calib/board/detect_circles.h"
#include "calib/board/observe_board.h"
#include "calib/board/other_board.h"
#include "calib/board/refine_corner.h"
#include "calib/board/search_size.h"
#include "calib/observations.h"
#include "core/error.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using Corners = std::vector<Vector2d>;

constexpr double kRefineWindow = 0.35;  // half the window of the refinement, in distances to the next corner

std::optional<Corners> locate_by_opencv(const cv::Mat& gray, const Target& target) {
  std::vector<cv::Point2f> points;
  if (!cv::findChessboardCornersSB(gray, cv::Size(target.columns, target.rows), points, 0))
    return std::nullopt;
  Corners corners;
  for (const auto& p : points) corners.emplace_back(p.x, p.y);
  return corners;
}

/// A missed corner from its neighbours in the row or column: between two, or beyond the last two.
std::optional<Vector2d> by_neighbours(const CornerGrid& grid, int x, int y) {
  const auto at = [&](int column, int row) -> std::optional<Vector2d> {
    const bool inside = column >= 0 && row >= 0 && column < grid.columns && row < grid.rows;
    return inside ? grid.at(column, row) : std::nullopt;
  };
  Vector2d sum = Vector2d::Zero();
  int count = 0;
  const auto add = [&](const std::optional<Vector2d>& a, double weight_a, const std::optional<Vector2d>& b) {
    if (!a || !b) return;
    sum += weight_a * *a + (1 - weight_a) * *b;
    ++count;
  };
  for (int dx = 0; dx <= 1; ++dx) {
    const int dy = 1 - dx;
    add(at(x - dx, y - dy), 0.5, at(x + dx, y + dy));
  }
  for (int dx = 0; dx <= 1 && count == 0; ++dx) {
    const int dy = 1 - dx;
    add(at(x - dx, y - dy), 2, at(x - 2 * dx, y - 2 * dy));
    add(at(x + dx, y + dy), 2, at(x + 2 * dx, y + 2 * dy));
  }
  return count > 0 ? std::optional<Vector2d>(sum / count) : std::nullopt;
}

/// The grid's corners; a few missed ones are filled in.
std::optional<Corners> complete(const CornerGrid& grid) {
  if (grid.count() < 0.9 * grid.columns * grid.rows) return std::nullopt;
  Corners corners;
  for (int y = 0; y < grid.rows; ++y) {
    for (int x = 0; x < grid.columns; ++x) {
      const auto corner = grid.at(x, y) ? grid.at(x, y) : by_neighbours(grid, x, y);
      if (!corner) return std::nullopt;
      corners.push_back(*corner);
    }
  }
  return corners;
}

/// How badly the corners fit a board that a lens shows, in squares.
double misfit_of(const Corners& corners, const Target& target) {
  const auto map = fit_board_map(corners, target);
  return map ? misfit(*map, target) : 1e9;
}

/// The part of the grid that is the target: links may run on into another pattern beside it, but then only
/// one part of the target's size is flat. In a larger board all parts are, and none is taken.
std::optional<Corners> target_in(const CornerGrid& grid, const Target& target) {
  constexpr double kClearly = 2.5;
  Corners best;
  double smallest = 1e9, second = 1e9;
  for (int top = 0; top + target.rows <= grid.rows; ++top) {
    for (int left = 0; left + target.columns <= grid.columns; ++left) {
      auto corners = complete(part(grid, left, top, target.columns, target.rows));
      if (!corners) continue;
      const double fit = misfit_of(*corners, target);
      second = std::min(second, std::max(fit, smallest));
      if (fit >= smallest) continue;
      smallest = fit;
      best = std::move(*corners);
    }
  }
  if (smallest > kMaxMisfit || second < kClearly * smallest) return std::nullopt;
  return best;
}

std::optional<Corners> locate_by_links(const std::vector<CornerGrid>& grids, const Target& target) {
  for (const auto& grid : grids) {
    if (auto corners = target_in(grid, target)) return corners;
    if (auto corners = target_in(turned(grid), target)) return corners;
  }
  return std::nullopt;
}

double distance_to_next(const Corners& corners, std::size_t i, int columns) {
  const auto c = static_cast<std::size_t>(columns);
  double nearest = 1e9;
  if (i % c > 0) nearest = std::min(nearest, (corners[i] - corners[i - 1]).norm());
  if (i % c + 1 < c) nearest = std::min(nearest, (corners[i] - corners[i + 1]).norm());
  if (i >= c) nearest = std::min(nearest, (corners[i] - corners[i - c]).norm());
  if (i + c < corners.size()) nearest = std::min(nearest, (corners[i] - corners[i + c]).norm());
  return nearest;
}

/// Each corner in a window of its own size: 0.02 to 0.04 px a coordinate in renders with 1.5 grey levels of
/// noise, where findChessboardCornersSB alone is at 0.05 to 0.14 px.
Corners refined(const cv::Mat& gray, const Corners& corners, const Target& target) {
  Corners result;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const int half = std::max(
        2, static_cast<int>(std::lround(kRefineWindow * distance_to_next(corners, i, target.columns))));
    result.push_back(refined_corner(gray, corners[i], half));
  }
  return result;
}

/// Where the refined place is far from the located one, something else pulled it there, like a laser line
/// over the corner: what such corners hold is where they were located.
struct RefinedCorners {
  Corners places;
  Corners pulled;  ///< those of `places` that are located only
};

RefinedCorners refine(const cv::Mat& gray, const Corners& located, const Target& target) {
  constexpr double kFar = 0.1;  // of the step to the next corner
  RefinedCorners result{refined(gray, located, target), {}};
  for (std::size_t i = 0; i < located.size(); ++i) {
    if ((result.places[i] - located[i]).norm() < kFar * distance_to_next(located, i, target.columns))
      continue;
    result.places[i] = located[i];
    result.pulled.push_back(located[i]);
  }
  return result;
}

/// A place that is located only is no measurement.
void forget(const Corners& pulled, Corners& corners) {
  for (auto& corner : corners)
    if (std::find(pulled.begin(), pulled.end(), corner) != pulled.end()) corner = unseen_corner();
}

double signed_area(const Corners& corners, const Target& target) {
  const Vector2d x = corners[static_cast<std::size_t>(target.columns - 1)] - corners.front();
  const Vector2d y =
      corners[static_cast<std::size_t>(target.num_corners() - target.columns)] - corners.front();
  return x.x() * y.y() - x.y() * y.x();
}

/// Mean grey level of the squares like the first one less that of the others.
double first_square_contrast(const cv::Mat& gray, const Corners& corners, const Target& target) {
  double sum[2] = {0, 0};
  int count[2] = {0, 0};
  for (int y = 0; y + 1 < target.rows; ++y) {
    for (int x = 0; x + 1 < target.columns; ++x) {
      const auto c = static_cast<std::size_t>(target.columns);
      const std::size_t i = static_cast<std::size_t>(y) * c + static_cast<std::size_t>(x), below = i + c;
      const Vector2d middle = 0.25 * (corners[i] + corners[i + 1] + corners[below] + corners[below + 1]);
      const cv::Point at(static_cast<int>(std::lround(middle.x())),
                         static_cast<int>(std::lround(middle.y())));
      if (!cv::Rect(0, 0, gray.cols, gray.rows).contains(at)) continue;
      sum[(x + y) % 2] += gray.at<std::uint8_t>(at);
      ++count[(x + y) % 2];
    }
  }
  return sum[0] / std::max(1, count[0]) - sum[1] / std::max(1, count[1]);
}

Corners in_unique_order(const cv::Mat& gray, Corners corners, const Target& target) {
  if (signed_area(corners, target) < 0)  // mirrored: turn each row round
    for (auto row = corners.begin(); row != corners.end(); row += target.columns)
      std::reverse(row, row + target.columns);
  if (!target.half_turn_symmetric() && first_square_contrast(gray, corners, target) > 0)
    std::reverse(corners.begin(), corners.end());
  return corners;
}

bool in_view(const cv::Mat& gray, const Corners& corners) {
  constexpr double kMarginPx = 2;
  return std::all_of(corners.begin(), corners.end(), [&](const Vector2d& p) {
    return p.minCoeff() >= kMarginPx && p.x() <= gray.cols - 1 - kMarginPx &&
           p.y() <= gray.rows - 1 - kMarginPx;
  });
}

/// Whether the squares go on beyond one of the corners' sides: then they are a part of a larger board.
bool goes_on(const Corners& corners, const Target& target, const std::vector<SaddleCorner>& saddles) {
  constexpr double kNear = 0.2, kMost = 0.7;  // of the step; of the side's corners
  const auto at = [&](int x, int y) { return corners[static_cast<std::size_t>(y * target.columns + x)]; };
  const auto is_saddle = [&](const Vector2d& place, double within) {
    return std::any_of(saddles.begin(), saddles.end(),
                       [&](const SaddleCorner& s) { return (s.position - place).norm() < within; });
  };
  const int c = target.columns, r = target.rows;
  std::array<int, 4> hits{};
  const auto look = [&](std::size_t side, const Vector2d& edge, const Vector2d& inner) {
    hits[side] += is_saddle(2 * edge - inner, kNear * (edge - inner).norm());
  };
  for (int x = 0; x < c; ++x) look(0, at(x, 0), at(x, 1)), look(1, at(x, r - 1), at(x, r - 2));
  for (int y = 0; y < r; ++y) look(2, at(0, y), at(1, y)), look(3, at(c - 1, y), at(c - 2, y));
  return hits[0] > kMost * c || hits[1] > kMost * c || hits[2] > kMost * r || hits[3] > kMost * r;
}

/// What a search at one size of the picture gave.
struct Located {
  std::optional<Corners> corners;  ///< of the full picture
  std::vector<SaddleCorner> saddles;
  std::vector<CornerGrid> grids;  ///< of the shrunk picture
};

Located search_by_links(const cv::Mat& gray, int factor, const Target& target) {
  Located result;
  result.saddles = find_saddle_corners(shrunk(gray, factor));
  result.grids = link_corners(result.saddles);
  if (auto corners = locate_by_links(result.grids, target))
    result.corners = enlarged(std::move(*corners), factor);
  return result;
}

/// cv::findChessboardCornersSB takes six times as long and is surer where squares are unclear: worth it only
/// where about half of the board's corners were linked.
bool worth_a_closer_look(const Located& located, const Target& target) {
  return !located.grids.empty() && 5 * located.grids.front().count() >= 2 * target.num_corners();
}

/// At the working size, at half of it (blurred pictures), and by OpenCV.
Located locate(const cv::Mat& gray, int factor, const Target& target) {
  constexpr int kMinSidePx = 240;  // of a picture that is searched at half size too
  Located result = search_by_links(gray, factor, target);
  if (result.corners) return result;
  Located coarse;
  if (std::min(gray.cols, gray.rows) / factor >= kMinSidePx) {
    coarse = search_by_links(gray, 2 * factor, target);
    if (coarse.corners && !goes_on(*coarse.corners, target, result.saddles)) {
      result.corners = std::move(coarse.corners);
      return result;
    }
  }
  const cv::Mat searched = shrunk(gray, factor);
  const bool other = !result.grids.empty() && is_other_board(searched, result.grids.front(), target);
  if (other || (!worth_a_closer_look(result, target) && !worth_a_closer_look(coarse, target))) return result;
  auto by_opencv = locate_by_opencv(searched, target);
  if (by_opencv && !goes_on(*by_opencv, target, result.saddles))
    result.corners = enlarged(std::move(*by_opencv), factor);
  return result;
}

BoardDetection detect_checkerboard(const cv::Mat& gray, const Target& target) {
  const int factor = search_factor(gray);
  const Located located = locate(gray, factor, target);
  BoardDetection result;
  if (located.corners) {
    const auto [corners, pulled] = refine(gray, *located.corners, target);
    result.found = 10 * pulled.size() <= corners.size() && in_view(gray, corners) &&
                   misfit_of(corners, target) < kMaxMisfit && has_squares_beyond(gray, corners, target);
    if (result.found) result.corners = in_unique_order(gray, corners, target);
    forget(pulled, result.corners);
  }
  if (result.found) return result;
  result.reason = why_not_found(shrunk(gray, factor), target, located.grids);
  result.board_like = !located.grids.empty();
  if (result.board_like) {
    const auto& seen = located.grids.front();
    const bool turned = (seen.columns < seen.rows) != (target.columns < target.rows);
    result.seen_columns = turned ? seen.rows : seen.columns;
    result.seen_rows = turned ? seen.columns : seen.rows;
  }
  return result;
}

}  // namespace

BoardDetection detect_board(ImageView8 image, const Target& target) {
  LIGHTSTRIPE_CHECK(target.columns >= 3 && target.rows >= 3, "a board needs at least 3 x 3 corners");
  BoardDetection result;
  if (image.empty()) {
    result.reason = "the image is empty";
    return result;
  }
  const cv::Mat gray(image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.data),
                     static_cast<std::size_t>(image.stride));
  if (target.type == TargetType::kCharuco) return detect_charuco(gray, target);
  if (target.type == TargetType::kAprilgrid) return detect_aprilgrid(gray, target);
  if (target.has_circles()) return detect_circles(gray, target);
  return detect_checkerboard(gray, target);
}

BoardDetection detect_board(std::span<const ImageView8> candidates, const Target& target) {
  BoardDetection first;
  first.reason = "there is no image";
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    BoardDetection detection = detect_board(candidates[i], target);
    detection.image = i;
    if (detection.found) return detection;
    if (i == 0) first = detection;
  }
  return first;
}

}  // namespace lightstripe
