// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <optional>

#include "calib/board/aruco_dictionary.h"
#include "calib/board/board_reasons.h"
#include "calib/board/detect_circles.h"
#include "calib/board/refine_corner.h"
#include "calib/observations.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

constexpr int kMinTags = 4;

struct Tag {
  int id = 0;
  std::array<Vector2d, 4> corners;
  Vector2d middle() const { return 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]); }
};

/// Kalibr prints tags with a border of two bits, the makers of the family with one.
std::vector<Tag> find_tags(const cv::Mat& gray, int border_bits, int count) {
  const auto dictionary = aruco_dictionary("DICT_APRILTAG_36h11");
  const auto parameters = cv::aruco::DetectorParameters::create();
  parameters->markerBorderBits = border_bits;
  std::vector<std::vector<cv::Point2f>> markers;
  std::vector<int> ids;
  cv::aruco::detectMarkers(gray, dictionary, markers, ids, parameters);
  std::vector<Tag> tags;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (ids[i] < 0 || ids[i] >= count) continue;
    Tag tag;
    tag.id = ids[i];
    for (std::size_t k = 0; k < 4; ++k) tag.corners[k] = {markers[i][k].x, markers[i][k].y};
    tags.push_back(tag);
  }
  std::sort(tags.begin(), tags.end(), [](const Tag& a, const Tag& b) { return a.id < b.id; });
  return tags;
}

/// Index of the tag's upper left corner in the target's list; tag 0 lies at the lower left.
int first_corner(const Target& target, int id) {
  const int columns = target.columns / 2, rows = target.rows / 2;
  return 2 * (rows - 1 - id / columns) * target.columns + 2 * (id % columns);
}

std::array<int, 4> corners_of_tag(const Target& target, int id) {
  const int first = first_corner(target, id);
  return {first, first + 1, first + target.columns, first + target.columns + 1};
}

/// Pixel from board by the tags' middles, which do not depend on how a tag is turned in itself.
std::optional<Eigen::Matrix3d> rough_map(const std::vector<Tag>& tags, const Target& target) {
  std::vector<cv::Point2d> board, pixels;
  for (const Tag& tag : tags) {
    Vector2d middle = Vector2d::Zero();
    for (const int i : corners_of_tag(target, tag.id)) middle += 0.25 * target.corner(i);
    board.emplace_back(middle.x(), middle.y());
    pixels.emplace_back(tag.middle().x(), tag.middle().y());
  }
  const cv::Mat H = cv::findHomography(board, pixels, cv::RANSAC, 3.0);
  if (H.empty()) return std::nullopt;
  Eigen::Matrix3d map;
  for (int i = 0; i < 9; ++i) map(i / 3, i % 3) = H.at<double>(i / 3, i % 3);
  return map;
}

/// Each corner of a tag goes to the place in the list that the map puts next to it; a tag that the map does
/// not explain is left out.
void place_corners(const std::vector<Tag>& tags, const Eigen::Matrix3d& map, const Target& target,
                   std::vector<Vector2d>& corners) {
  for (const Tag& tag : tags) {
    const double side = (tag.corners[1] - tag.corners[0]).norm();
    for (const int i : corners_of_tag(target, tag.id)) {
      const Vector2d expected = (map * target.corner(i).homogeneous()).hnormalized();
      const auto nearest = std::min_element(
          tag.corners.begin(), tag.corners.end(),
          [&](const auto& a, const auto& b) { return (a - expected).norm() < (b - expected).norm(); });
      if ((*nearest - expected).norm() < 0.25 * side) corners[static_cast<std::size_t>(i)] = *nearest;
    }
  }
}

/// The smaller of a tag's two heights over its sides: how thin it is seen.
double height_px(const Tag& tag) {
  const Vector2d x = tag.corners[1] - tag.corners[0], y = tag.corners[2] - tag.corners[1];
  return std::abs(x.x() * y.y() - x.y() * y.x()) / std::max(x.norm(), y.norm());
}

void refine_tag_corners(const cv::Mat& gray, const Target& target, const std::vector<Tag>& tags,
                        std::vector<Vector2d>& corners) {
  for (const Tag& tag : tags) {
    const double side = (tag.corners[1] - tag.corners[0]).norm();
    // The window stays clear of the next corner, a gap away, and of the tag's bits, along the tag's shorter
    // side.
    const double gap_px = height_px(tag) * std::min(target.tag_gap_mm / target.marker_mm, 0.3);
    const int half = std::max(2, static_cast<int>(std::lround(0.6 * gap_px)));
    for (const int i : corners_of_tag(target, tag.id)) {
      auto& corner = corners[static_cast<std::size_t>(i)];
      if (!is_seen(corner)) continue;
      const Vector2d refined = refined_corner(gray, corner, half);
      corner = (refined - corner).norm() < 0.2 * side ? refined : unseen_corner();
    }
  }
}

/// Whether the tags are numbered the other way round than Kalibr's: seen in a mirror.
bool mirrored(const Eigen::Matrix3d& map, const Target& target) {
  const auto at = [&](const Vector2d& p) -> Vector2d { return (map * p.homogeneous()).hnormalized(); };
  const Vector2d p = target.middle(), x = at(p + Vector2d(1, 0)) - at(p), y = at(p + Vector2d(0, 1)) - at(p);
  return x.x() * y.y() - x.y() * y.x() < 0;
}

}  // namespace

BoardDetection detect_aprilgrid(const cv::Mat& gray, const Target& target) {
  const int count = target.num_corners() / 4;
  auto tags = find_tags(gray, 2, count);
  if (static_cast<int>(tags.size()) < kMinTags) tags = find_tags(gray, 1, count);
  BoardDetection result;
  if (tags.empty()) {
    result.reason = why_not_found(gray, target, {});
    return result;
  }
  result.board_like = true;
  const auto map = static_cast<int>(tags.size()) >= kMinTags ? rough_map(tags, target) : std::nullopt;
  if (!map) {
    result.reason = fmt::format(
        "{} of {} tags in view, {} that are not on one line are needed; bring more of "
        "the board into view",
        tags.size(), count, kMinTags);
    return result;
  }
  if (mirrored(*map, target)) {
    result.reason = "the tags are numbered the other way round: is the picture mirrored?";
    return result;
  }
  result.corners.assign(static_cast<std::size_t>(target.num_corners()), unseen_corner());
  place_corners(tags, *map, target, result.corners);
  refine_tag_corners(gray, target, tags, result.corners);
  result.found =
      std::count_if(result.corners.begin(), result.corners.end(), is_seen) >= std::ptrdiff_t{4} * kMinTags;
  if (!result.found) {
    result.corners.clear();
    result.reason = "the tags do not lie as in the grid that the session describes";
  }
  return result;
}

}  // namespace lightstripe
