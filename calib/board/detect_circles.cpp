// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/board/detect_circles.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "calib/board/board_map.h"
#include "calib/board/board_reasons.h"
#include "calib/board/search_size.h"
#include "core/robust.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using Corners = std::vector<Vector2d>;

cv::Ptr<cv::SimpleBlobDetector> blob_detector(const cv::Mat& gray, const Target& target, bool dark) {
  cv::SimpleBlobDetector::Params params;
  params.blobColor = dark ? 0 : 255;
  params.minArea = 20;
  params.maxArea = static_cast<float>(gray.total()) / static_cast<float>(target.num_corners());
  params.minThreshold = 20;
  params.maxThreshold = 240;
  params.thresholdStep = 15;
  params.minDistBetweenBlobs = 3;
  return cv::SimpleBlobDetector::create(params);
}

std::optional<Corners> locate_circles(const cv::Mat& gray, const Target& target, bool dark) {
  const int kind =
      target.type == TargetType::kCircles ? cv::CALIB_CB_SYMMETRIC_GRID : cv::CALIB_CB_ASYMMETRIC_GRID;
  const cv::Size size(target.columns, target.rows);
  std::vector<cv::Point2f> centers;
  const auto blobs = blob_detector(gray, target, dark);
  const bool found = cv::findCirclesGrid(gray, size, centers, kind, blobs) ||
                     cv::findCirclesGrid(gray, size, centers, kind | cv::CALIB_CB_CLUSTERING, blobs);
  if (!found) return std::nullopt;
  Corners corners;
  for (const auto& p : centers) corners.emplace_back(p.x, p.y);
  return corners;
}

/// Of the four ways to list the grid the right-handed one that fits the board best.
std::optional<Corners> in_unique_order(const Corners& corners, const Target& target) {
  std::optional<Corners> best;
  double smallest = kMaxMisfit;
  for (const bool mirrored : {false, true}) {
    for (const bool reversed : {false, true}) {
      Corners listed = corners;
      if (mirrored)
        for (auto row = listed.begin(); row != listed.end(); row += target.columns)
          std::reverse(row, row + target.columns);
      if (reversed) std::reverse(listed.begin(), listed.end());
      const auto map = fit_board_map(listed, target);
      if (!map || misfit(*map, target) >= smallest || map->derivative(map->centre).determinant() <= 0)
        continue;
      smallest = 0.7 * misfit(*map, target);  // symmetric boards: the first of two equal ones stays
      best = std::move(listed);
    }
  }
  return best;
}

double distance_to_next(const Corners& corners, std::size_t i) {
  double nearest = 1e9;
  for (std::size_t k = 0; k < corners.size(); ++k)
    if (k != i) nearest = std::min(nearest, (corners[k] - corners[i]).norm());
  return nearest;
}

struct Disc {
  Vector2d centre;
  double area_px2 = 0;
};

/// Centre of gravity and area of the disc around `start`, of soft weights that are 0 on the ground and 1 on
/// the disc; nothing where there is no contrast or the window leaves the picture.
std::optional<Disc> measured(const cv::Mat& gray, const Vector2d& start, double radius_px) {
  constexpr double kMinContrast = 12;  // grey levels
  const cv::Rect picture(0, 0, gray.cols, gray.rows);
  const cv::Point low(static_cast<int>(std::floor(start.x() - radius_px)),
                      static_cast<int>(std::floor(start.y() - radius_px)));
  const int side = 2 * static_cast<int>(std::ceil(radius_px)) + 1;
  const cv::Rect window(low, cv::Size(side, side));
  if ((window & picture) != window) return std::nullopt;
  const auto inside = [&](int x, int y) { return std::hypot(x - start.x(), y - start.y()) <= radius_px; };
  std::vector<int> rim;
  for (int y = window.y; y < window.y + side; ++y)
    for (int x = window.x; x < window.x + side; ++x)
      if (inside(x, y) && std::hypot(x - start.x(), y - start.y()) > 0.85 * radius_px)
        rim.push_back(gray.at<std::uint8_t>(y, x));
  if (rim.size() < 8) return std::nullopt;
  const double ground = upper_median(rim);
  const cv::Point at(static_cast<int>(std::lround(start.x())), static_cast<int>(std::lround(start.y())));
  const double disc = cv::mean(gray(cv::Rect(at.x - 1, at.y - 1, 3, 3) & picture))[0];
  if (std::abs(disc - ground) < kMinContrast) return std::nullopt;
  Disc result{Vector2d::Zero(), 0};
  for (int y = window.y; y < window.y + side; ++y) {
    for (int x = window.x; x < window.x + side; ++x) {
      if (!inside(x, y)) continue;
      const double share = (gray.at<std::uint8_t>(y, x) - ground) / (disc - ground);
      const double weight = std::clamp((share - 0.2) / 0.6, 0.0, 1.0);  // noise of the ground weighs nothing
      result.centre += weight * Vector2d(x, y);
      result.area_px2 += weight;
    }
  }
  result.centre /= result.area_px2;
  return result;
}

/// Moves the corners to the discs' centres of gravity; returns the discs' median diameter, mm, 0 where one of
/// them cannot be measured.
double refine_circles(const cv::Mat& gray, const Target& target, Corners& corners) {
  const auto rough = corners;
  std::vector<double> areas;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    auto disc = measured(gray, rough[i], 0.5 * distance_to_next(rough, i));
    if (disc) disc = measured(gray, disc->centre, 0.5 * distance_to_next(rough, i));
    if (!disc) return 0;
    corners[i] = disc->centre;
    areas.push_back(disc->area_px2);
  }
  const auto map = fit_board_map(corners, target);
  if (!map) return 0;
  std::vector<double> diameters;
  for (std::size_t i = 0; i < corners.size(); ++i)
    diameters.push_back(
        2 * std::sqrt(areas[i] * std::abs(map->derivative(corners[i]).determinant()) / std::numbers::pi));
  return upper_median(diameters);
}

}  // namespace

BoardDetection detect_circles(const cv::Mat& gray, const Target& target) {
  BoardDetection result;
  const int factor = search_factor(gray);
  const cv::Mat small = shrunk(gray, factor);
  auto located = locate_circles(small, target, true);
  if (!located) located = locate_circles(small, target, false);
  if (located) {
    *located = enlarged(std::move(*located), factor);
    result.circle_mm = refine_circles(gray, target, *located);
    if (const auto listed = in_unique_order(*located, target); listed && result.circle_mm > 0) {
      result.found = true;
      result.corners = *listed;
      return result;
    }
  }
  result.reason = why_no_circles(small, target);
  return result;
}

}  // namespace lightstripe
