// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Circle grids and AprilGrids in rendered pictures, against a checkerboard of the same size.
#include "calib/board/detect_circles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "calib/board/marker_cells.h"
#include "calib/board/observe_board.h"
#include "calib/observations.h"
#include "calib/start/correct_circles.h"
#include "core/random.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using ::testing::HasSubstr;

const Camera kCamera{800, 600, 1500, 1500, 402, 296, {}};

/// The board's middle at a place, tilted and turned.
Rigid3 pose_of(const Target& target, double tilt_x, double tilt_y, double roll, double depth) {
  const Eigen::Quaterniond q = Eigen::AngleAxisd(tilt_x * kDegree, Vector3d::UnitX()) *
                               Eigen::AngleAxisd(tilt_y * kDegree, Vector3d::UnitY()) *
                               Eigen::AngleAxisd(roll * kDegree, Vector3d::UnitZ());
  const Vector3d middle(target.middle().x(), target.middle().y(), 0);
  return {q, Vector3d(3, -4, depth) - q * middle};
}

bool black_square(const Target& t, const Vector2d& p) {
  const double i = std::floor(p.x() / t.pitch_x), j = std::floor(p.y() / t.pitch_y);
  return i >= -1 && j >= -1 && i < t.columns && j < t.rows && static_cast<int>(i + j + 4) % 2 == 0;
}

bool black_disc(const Target& t, const Vector2d& p) {
  for (int i = 0; i < t.num_corners(); ++i)
    if ((p - t.corner(i)).norm() < 0.5 * t.circle_mm) return true;
  return false;
}

bool black_tag(const Target& t, const Vector2d& p) {
  const double step = t.marker_mm + t.tag_gap_mm;
  const int columns = t.columns / 2, rows = t.rows / 2;
  const int i = static_cast<int>(std::floor(p.x() / step)), j = static_cast<int>(std::floor(p.y() / step));
  const Vector2d in = p - step * Vector2d(i, j);
  const bool corner =
      in.x() > t.marker_mm && in.y() > t.marker_mm && i >= -1 && j >= -1 && i < columns && j < rows;
  if (corner) return true;
  if (i < 0 || j < 0 || i >= columns || j >= rows || in.maxCoeff() >= t.marker_mm) return false;
  static std::map<int, MarkerCells> tags;
  const int id = (rows - 1 - j) * columns + i;
  if (!tags.count(id)) tags[id] = marker_cells("DICT_APRILTAG_36h11", id, 2);
  const double cell = t.marker_mm / tags[id].side;
  return tags[id].black(static_cast<int>(in.x() / cell), static_cast<int>(in.y() / cell));
}

bool black(const Target& t, const Vector2d& p) {
  if (t.has_circles()) return black_disc(t, p);
  return t.type == TargetType::kAprilgrid ? black_tag(t, p) : black_square(t, p);
}

/// Black 40 on white 200, four by four samples a pixel, a lens of 0.7 px, noise of 1.5 grey levels.
Image8 rendered(const Target& target, const Rigid3& cam_from_board, std::uint64_t seed) {
  constexpr int kSamples = 4;
  const Rigid3 board_from_cam = cam_from_board.inverse();
  const Vector3d centre = board_from_cam.translation;
  cv::Mat1f picture(kCamera.height, kCamera.width);
  for (int y = 0; y < kCamera.height; ++y)
    for (int x = 0; x < kCamera.width; ++x) {
      int dark = 0;
      for (int k = 0; k < kSamples * kSamples; ++k) {
        const double u = x - 0.5 + (k % kSamples + 0.5) / kSamples,
                     v = y - 0.5 + (k / kSamples + 0.5) / kSamples;
        const Vector3d ray = board_from_cam.rotation *
                             Vector3d((u - kCamera.cx) / kCamera.fx, (v - kCamera.cy) / kCamera.fy, 1);
        const Vector3d p = centre - centre.z() / ray.z() * ray;
        dark += black(target, p.head<2>());
      }
      picture(y, x) = 200 - 160.0F * static_cast<float>(dark) / (kSamples * kSamples);
    }
  cv::GaussianBlur(picture, picture, {}, 0.7);
  Random random(seed);
  Image8 image(kCamera.width, kCamera.height);
  for (int y = 0; y < kCamera.height; ++y)
    for (int x = 0; x < kCamera.width; ++x)
      image(x, y) = static_cast<std::uint8_t>(std::lround(picture(y, x) + 1.5 * random.gaussian()));
  return image;
}

Target circles() {
  Target target{TargetType::kCircles, 9, 7, 14, 14};
  target.circle_mm = 7;
  return target;
}

Target asymmetric() {
  Target target{TargetType::kAsymmetricCircles, 4, 11, 11, 11};
  target.circle_mm = 8;
  return target;
}

Target tags() {
  Target target{TargetType::kAprilgrid, 10, 8};
  target.marker_mm = 18;
  target.tag_gap_mm = 5.4;
  target.pitch_x = target.pitch_y = 11.7;
  return target;
}

/// What a board tells of its place: rms of a corner's coordinate over three poses, px, by the root of the
/// number of corners. The discs' bias is that of correct_circles().
double error_px(const Target& target) {
  double sum = 0;
  int count = 0;
  for (int i = 0; i < 3; ++i) {
    const Rigid3 pose = pose_of(target, 25.0 - 25 * i, 15.0 * i - 10, 8.0 * i - 5, 430 + 20.0 * i);
    Target unknown = target;
    unknown.circle_mm = 0;
    const auto found = detect_board(rendered(target, pose, static_cast<std::uint64_t>(i)), unknown);
    EXPECT_TRUE(found.found) << found.reason;
    if (!found.found) return 1e9;
    EXPECT_NEAR(found.circle_mm, target.circle_mm, 0.03 * target.circle_mm);
    double best = 1e300;
    for (const bool reversed : {false, true}) {  // a grid of equal circles may be listed from either end
      double squares = 0;
      for (int k = 0; k < target.num_corners(); ++k) {
        const Vector2d p = target.corner(k);
        Vector2d expected = *project(kCamera, pose * Vector3d(p.x(), p.y(), 0));
        if (target.has_circles()) expected += disc_bias_px(kCamera, pose, p, target.circle_mm);
        const auto& seen =
            found.corners[static_cast<std::size_t>(reversed ? target.num_corners() - 1 - k : k)];
        if (is_seen(seen)) squares += (seen - expected).squaredNorm();
      }
      best = std::min(best, squares);
    }
    sum += best;
    count += 2 * static_cast<int>(std::count_if(found.corners.begin(), found.corners.end(), is_seen));
  }
  return std::sqrt(sum / count) / std::sqrt(count / 6.0);
}

TEST(DetectCircles, CirclesAndTagsAreAsGoodAsACheckerboardOfTheSameSize) {
  const double squares = error_px({TargetType::kCheckerboard, 9, 7, 14, 14});
  EXPECT_LT(squares, 0.04 / std::sqrt(63.0));
  EXPECT_LT(error_px(circles()), 1.2 * squares);
  EXPECT_LT(error_px(asymmetric()), 1.2 * squares);
  EXPECT_LT(error_px(tags()), 1.2 * squares);
}

TEST(DetectCircles, TheBiasOfADiscIsTheOneOfAFinePolygon) {
  Camera camera = kCamera;
  camera.distortion = {-0.2, 0.1, 1e-3, -1e-3};
  const Target target = circles();
  const Rigid3 pose = pose_of(target, 35, 25, 10, 250);
  const Vector2d middle = target.corner(5);
  Vector2d sum = Vector2d::Zero();
  double area = 0;
  constexpr int kSides = 2000;
  const auto at = [&](int k) {
    const double angle = 2 * std::numbers::pi * k / kSides;
    const Vector2d p = middle + 0.5 * target.circle_mm * Vector2d(std::cos(angle), std::sin(angle));
    return *project(camera, pose * Vector3d(p.x(), p.y(), 0));
  };
  const Vector2d centre = *project(camera, pose * Vector3d(middle.x(), middle.y(), 0));
  for (int k = 0; k < kSides; ++k) {
    const Vector2d a = at(k) - centre, b = at(k + 1) - centre;
    const double part = 0.5 * (a.x() * b.y() - a.y() * b.x());
    sum += part * (a + b) / 3;
    area += part;
  }
  const Vector2d expected = sum / area, bias = disc_bias_px(camera, pose, middle, target.circle_mm);
  EXPECT_GT(expected.norm(), 0.1);
  EXPECT_LT((bias - expected).norm(), 0.02 * expected.norm());
}

TEST(DetectCircles, WhatIsNotThereIsNamed) {
  const Target squares{TargetType::kCheckerboard, 9, 7, 14, 14};
  const Rigid3 pose = pose_of(circles(), 10, 5, 0, 430);
  const Image8 picture = rendered(circles(), pose, 1);
  EXPECT_THAT(detect_board(picture, squares).reason, HasSubstr("this looks like a circle grid"));
  Target more = circles();
  more.columns = 12;
  EXPECT_THAT(detect_board(picture, more).reason,
              HasSubstr("no grid of 12 x 7 circles in view (63 round blobs"));
  EXPECT_THAT(detect_board(picture, tags()).reason, HasSubstr("circle grid"));
}

TEST(DetectBoard, APartOfALargerBoardIsNotTheTarget) {
  const Target board{TargetType::kCheckerboard, 11, 7, 12, 12},
      asked{TargetType::kCheckerboard, 10, 7, 12, 12};
  const auto found = detect_board(rendered(board, pose_of(board, 15, 10, 5, 450), 1), asked);
  EXPECT_FALSE(found.found);
  EXPECT_THAT(found.reason, HasSubstr("the board shows 11 x 7 inner corners, the session says 10 x 7"));
  EXPECT_EQ(found.seen_columns, 11);
  EXPECT_EQ(found.seen_rows, 7);
}

}  // namespace
}  // namespace lightstripe
