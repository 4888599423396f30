// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/board/board_shift.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "calib/board/observe_board.h"
#include "calib/observations.h"
#include "core/robust.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

constexpr int kReachPx = 4;         // of the search for a board that moved a little
constexpr double kSamePatch = 0.8;  // correlation of a corner's surroundings in both pictures
constexpr double kMinContrast = 4;  // grey levels, standard deviation in a patch that shows the board
constexpr std::size_t kMinPatches = 8;

cv::Mat as_mat(ImageView8 image) {
  return {image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.data),
          static_cast<std::size_t>(image.stride)};
}

/// Nearly half the distance to the next corner, 4 to 12 px.
int patch_half_px(const std::vector<Vector2d>& corners, std::size_t i) {
  double nearest = 30;
  for (std::size_t k = 0; k < corners.size(); ++k)
    if (k != i && is_seen(corners[k])) nearest = std::min(nearest, (corners[k] - corners[i]).norm());
  return std::clamp(static_cast<int>(0.4 * nearest), 4, 12);
}

double deviation(const cv::Mat& patch) {
  cv::Scalar mean, sigma;
  cv::meanStdDev(patch, mean, sigma);
  return sigma[0];
}

/// What the corners' patches tell.
struct Patches {
  std::vector<double> shifts_px;  ///< of those found again
  std::size_t visible = 0;        ///< with contrast in the second picture
};

Patches compare_patches(const cv::Mat& laser, const cv::Mat& board, const std::vector<Vector2d>& corners) {
  Patches result;
  const cv::Rect picture(0, 0, board.cols, board.rows);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (!is_seen(corners[i])) continue;
    const int half = patch_half_px(corners, i);
    const cv::Point at(static_cast<int>(std::lround(corners[i].x())),
                       static_cast<int>(std::lround(corners[i].y())));
    const cv::Rect patch(at.x - half, at.y - half, 2 * half + 1, 2 * half + 1);
    const cv::Rect around(patch.x - kReachPx, patch.y - kReachPx, patch.width + 2 * kReachPx,
                          patch.height + 2 * kReachPx);
    if ((around & picture) != around || deviation(laser(patch)) < kMinContrast) continue;
    ++result.visible;
    cv::Mat score;
    cv::matchTemplate(laser(around), board(patch), score, cv::TM_CCOEFF_NORMED);
    double best = 0;
    cv::Point place;
    cv::minMaxLoc(score, nullptr, &best, nullptr, &place);
    if (best > kSamePatch) result.shifts_px.push_back(std::hypot(place.x - kReachPx, place.y - kReachPx));
  }
  return result;
}

/// Median distance of the corners found in both pictures, whichever way they are listed.
double corner_shift_px(const std::vector<Vector2d>& a, const std::vector<Vector2d>& b) {
  std::vector<double> same, reversed;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto& other = b[b.size() - 1 - i];
    if (is_seen(a[i]) && is_seen(b[i])) same.push_back((a[i] - b[i]).norm());
    if (is_seen(a[i]) && is_seen(other)) reversed.push_back((a[i] - other).norm());
  }
  if (same.empty()) return reversed.empty() ? 0 : upper_median(reversed);
  return reversed.empty() ? upper_median(same) : std::min(upper_median(same), upper_median(reversed));
}

}  // namespace

std::optional<double> board_shift_px(ImageView8 laser, ImageView8 board, const std::vector<Vector2d>& corners,
                                     const Target& target) {
  const Patches patches = compare_patches(as_mat(laser), as_mat(board), corners);
  if (patches.visible < kMinPatches) return std::nullopt;
  if (2 * patches.shifts_px.size() > patches.visible) return upper_median(std::vector(patches.shifts_px));
  // Something else stands there: the board, elsewhere?
  const BoardDetection again = detect_board(laser, target);
  if (!again.found) return std::nullopt;
  return corner_shift_px(corners, again.corners);
}

}  // namespace lightstripe
