// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/board/board_reasons.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "core/counted.h"
#include "core/robust.h"

namespace lightstripe {
namespace {

/// Grey levels below which `share` of the pixels lie.
int grey_percentile(const cv::Mat& gray, double share) {
  std::array<int, 256> histogram{};
  for (int y = 0; y < gray.rows; ++y)
    for (int x = 0; x < gray.cols; ++x) ++histogram[gray.at<std::uint8_t>(y, x)];
  double below = 0;
  for (int level = 0; level < 256; ++level) {
    below += histogram[static_cast<std::size_t>(level)];
    if (below >= share * gray.rows * gray.cols) return level;
  }
  return 255;
}

/// Whether a corner of the grid lies within about a square of the border.
bool touches_border(const CornerGrid& grid, const cv::Mat& gray) {
  double square = 0;
  for (int y = 0; y < grid.rows; ++y)
    for (int x = 0; x + 1 < grid.columns; ++x)
      if (grid.at(x, y) && grid.at(x + 1, y))
        square = std::max(square, (*grid.at(x, y) - *grid.at(x + 1, y)).norm());
  const double margin = 1.6 * square;
  return std::any_of(grid.cells.begin(), grid.cells.end(), [&](const auto& cell) {
    return cell && (cell->x() < margin || cell->y() < margin || cell->x() > gray.cols - margin ||
                    cell->y() > gray.rows - margin);
  });
}

bool same_size(const CornerGrid& grid, const Target& target) {
  return (grid.columns == target.columns && grid.rows == target.rows) ||
         (grid.columns == target.rows && grid.rows == target.columns);
}

/// The size that was seen, listed like the target's: the longer side where the target has it.
std::string size_seen(const CornerGrid& grid, const Target& target) {
  const int longer = std::max(grid.columns, grid.rows), shorter = std::min(grid.columns, grid.rows);
  return target.columns >= target.rows ? fmt::format("{} x {}", longer, shorter)
                                       : fmt::format("{} x {}", shorter, longer);
}

std::string about_grid(const CornerGrid& grid, const cv::Mat& gray, const Target& target) {
  if (same_size(grid, target) && !touches_border(grid, gray))
    return fmt::format("{} of {} corners {} hidden or unclear", target.num_corners() - grid.count(),
                       target.num_corners(), noun_of(target.num_corners() - grid.count(), "is", "are"));
  const bool smaller = std::max(grid.columns, grid.rows) <= std::max(target.columns, target.rows) &&
                       std::min(grid.columns, grid.rows) <= std::min(target.columns, target.rows);
  if (smaller && touches_border(grid, gray))
    return fmt::format("cut off by the image's border: {} of {} x {} inner corners in view",
                       size_seen(grid, target), target.columns, target.rows);
  return fmt::format("the board shows {} inner corners, the session says {} x {}", size_seen(grid, target),
                     target.columns, target.rows);
}

}  // namespace

double edge_width_px(const cv::Mat& gray) {
  const double range = grey_percentile(gray, 0.98) - grey_percentile(gray, 0.02);
  cv::Mat1f smooth, dx, dy;
  gray.convertTo(smooth, CV_32F);
  cv::GaussianBlur(smooth, smooth, {}, 1.0);
  cv::Sobel(smooth, dx, CV_32F, 1, 0, 3, 1.0 / 8);
  cv::Sobel(smooth, dy, CV_32F, 0, 1, 3, 1.0 / 8);
  cv::Mat1f steepness;
  cv::magnitude(dx, dy, steepness);
  std::vector<float> sorted(steepness.begin(), steepness.end());
  const auto high = sorted.begin() + static_cast<std::ptrdiff_t>(0.998 * static_cast<double>(sorted.size()));
  std::nth_element(sorted.begin(), high, sorted.end());
  // A step of height `range` blurred by s has the slope range / (sqrt(2 pi) s), and 2.56 s from 10 to 90 %.
  const double s = range / (std::sqrt(2 * std::numbers::pi) * std::max(1e-3, static_cast<double>(*high)));
  return 2.56 * std::sqrt(std::max(0.0, s * s - 1.0));
}

namespace {

/// Round blobs of one size, dark on light: the discs of a circle grid.
int round_blobs(const cv::Mat& gray) {
  cv::SimpleBlobDetector::Params params;
  params.filterByCircularity = true;
  params.minCircularity = 0.75F;
  params.minArea = 30;
  params.maxArea = static_cast<float>(gray.total()) / 40;
  params.thresholdStep = 40;
  std::vector<cv::KeyPoint> blobs;
  cv::SimpleBlobDetector::create(params)->detect(gray, blobs);
  std::vector<float> sizes;
  for (const auto& blob : blobs) sizes.push_back(blob.size);
  if (sizes.empty()) return 0;
  const float median = upper_median(sizes);
  return static_cast<int>(std::count_if(
      sizes.begin(), sizes.end(), [&](float size) { return std::abs(size - median) < 0.25F * median; }));
}

/// A picture that shows nothing at all; empty where it shows something.
std::string about_light(const cv::Mat& gray) {
  constexpr int kDark = 35, kFlat = 25;  // grey levels
  const int light = grey_percentile(gray, 0.98), dark = grey_percentile(gray, 0.02);
  if (light < kDark)
    return fmt::format("too dark: nearly all pixels are below grey level {}; more light or exposure",
                       light + 1);
  if (light - dark < kFlat) return fmt::format("no contrast: grey levels {} to {} only", dark, light);
  return "";
}

std::string about_focus(const cv::Mat& gray) {
  constexpr double kBlurredPx = 8;
  const double edge = edge_width_px(gray);
  if (edge <= kBlurredPx) return "";
  return fmt::format("blurred: edges are {:.0f} px wide; focus, or hold the board still", edge);
}

}  // namespace

std::string why_not_found(const cv::Mat& gray, const Target& target, const std::vector<CornerGrid>& grids) {
  constexpr int kGridOfCircles = 16;
  if (auto reason = about_light(gray); !reason.empty()) return reason;
  const bool seen = !grids.empty() && grids.front().count() >= std::min(12, target.num_corners() / 2);
  if (seen) return about_grid(grids.front(), gray, target);
  if (auto reason = about_focus(gray); !reason.empty()) return reason;
  if (round_blobs(gray) >= kGridOfCircles)
    return "this looks like a circle grid; say target: {type: circles, grid: [columns, rows], pitch: mm}";
  if (target.type == TargetType::kAprilgrid) return "no tag of the family 36h11 in view";
  return fmt::format("no board of {} x {} inner corners in view (hidden, cut off, or too steep)",
                     target.columns, target.rows);
}

std::string why_no_circles(const cv::Mat& gray, const Target& target) {
  if (auto reason = about_light(gray); !reason.empty()) return reason;
  if (auto reason = about_focus(gray); !reason.empty()) return reason;
  const int seen = round_blobs(gray);
  return fmt::format("no grid of {} x {} circles in view ({} of one size {} seen)", target.columns,
                     target.rows, counted(seen, "round blob"), noun_of(seen, "is", "are"));
}

}  // namespace lightstripe
