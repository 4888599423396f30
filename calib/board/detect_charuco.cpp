// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/board/detect_charuco.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/aruco/charuco.hpp>

#include "calib/board/aruco_dictionary.h"
#include "calib/board/board_reasons.h"
#include "calib/board/refine_corner.h"
#include "calib/board/seen_corners.h"
#include "core/counted.h"
#include "core/error.h"
#include "core/linear_algebra.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

constexpr int kMinCorners = 8;
constexpr double kMarkerWindow = 0.8;  // half the window, as a share of the gap between corner and markers

bool on_one_line(const std::vector<Vector2d>& corners, const Target& target) {
  const std::vector<Vector2d> seen = seen_corners(corners, target).board;
  const double count = std::max(1.0, static_cast<double>(seen.size()));
  Vector2d mean = Vector2d::Zero();
  for (const Vector2d& p : seen) mean += p / count;
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (const Vector2d& p : seen) scatter += (p - mean) * (p - mean).transpose() / count;
  return symmetric_eigen(scatter).values[0] <
         0.05 * std::min(target.pitch_x, target.pitch_y) * std::min(target.pitch_x, target.pitch_y);
}

/// Distance in the image to the nearest seen neighbour in the row or column.
double square_px(const std::vector<Vector2d>& corners, const Target& target, int i) {
  double nearest = 1e9;
  const int x = i % target.columns, y = i / target.columns;
  for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
    if (x + dx < 0 || x + dx >= target.columns || y + dy < 0 || y + dy >= target.rows) continue;
    const auto& other = corners[static_cast<std::size_t>(i + dx + dy * target.columns)];
    if (is_seen(other)) nearest = std::min(nearest, (other - corners[static_cast<std::size_t>(i)]).norm());
  }
  return nearest;
}

void refine_between_markers(const cv::Mat& gray, const Target& target, std::vector<Vector2d>& corners) {
  const auto rough = corners;
  for (int i = 0; i < target.num_corners(); ++i) {
    auto& corner = corners[static_cast<std::size_t>(i)];
    if (!is_seen(corner)) continue;
    const double side = square_px(rough, target, i);
    if (side > 1e8) {
      corner = unseen_corner();  // alone: no neighbour vouches for it
      continue;
    }
    const double gap_px = side * (target.pitch_x - target.marker_mm) / 2 / target.pitch_x;
    const int half = std::max(2, static_cast<int>(kMarkerWindow * gap_px));
    corner = refined_corner(gray, corner, half);
  }
}

}  // namespace

BoardDetection detect_charuco(const cv::Mat& gray, const Target& target) {
  const auto dictionary = aruco_dictionary(target.dictionary);
  const auto board =
      cv::aruco::CharucoBoard::create(target.columns + 1, target.rows + 1, static_cast<float>(target.pitch_x),
                                      static_cast<float>(target.marker_mm), dictionary);
  std::vector<std::vector<cv::Point2f>> markers;
  std::vector<int> ids;
  cv::aruco::detectMarkers(gray, dictionary, markers, ids);
  BoardDetection result;
  if (ids.empty()) {
    result.reason = why_not_found(gray, target, {});
    return result;
  }
  cv::Mat corners, corner_ids;
  cv::aruco::interpolateCornersCharuco(markers, ids, gray, board, corners, corner_ids);
  result.corners.assign(static_cast<std::size_t>(target.num_corners()), unseen_corner());
  for (int i = 0; i < corner_ids.rows; ++i) {
    const auto p = corners.at<cv::Point2f>(i);
    result.corners[static_cast<std::size_t>(corner_ids.at<int>(i))] = {p.x, p.y};
  }
  refine_between_markers(gray, target, result.corners);
  const auto seen = std::count_if(result.corners.begin(), result.corners.end(), is_seen);
  result.found = seen >= kMinCorners && !on_one_line(result.corners, target);
  if (!result.found) {
    result.corners.clear();
    result.reason = fmt::format(
        "{} and {} of {} corners in view, {} corners that are not on one line are needed; "
        "bring more of the board into view",
        counted(ids.size(), "marker"), seen, target.num_corners(), kMinCorners);
  }
  return result;
}

}  // namespace lightstripe
