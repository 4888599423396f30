// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "simulate/render.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>
#include <opencv2/imgproc.hpp>

#include "scenes.h"
#include "simulate/board_poses.h"
#include "simulate/stripe_truth.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

World white_ground() {
  World world;
  world.ground = GroundObject{0, {1, 0, 1}};
  return world;
}

TEST(Render, FlatGroundHasTheLevelOfTheModel) {
  Imaging imaging = noise_free();
  imaging.light = {0.6, 0, 0.8};
  const SimulatedSensor sensor = make_sensor(looking_down(64, 48));
  const Image<float> image = rendered(white_ground(), {&sensor, Vector3d::Zero(), 100, false}, imaging);
  // 40 % of the lamp's light comes from everywhere, the rest falls in with cosine 0.8.
  for (const float level : image.pixels) EXPECT_NEAR(level, 5 + 100 * (0.4 + 0.6 * 0.8), 1e-3);
}

TEST(Render, LaserHasTheBrightnessOfItsModelAtItsAim) {
  Imaging imaging = noise_free();
  imaging.blur_sigma_px = 0;
  const SimulatedSensor sensor = make_sensor(looking_down());
  const SurfaceHit up{0, Vector3d::UnitZ(), {1, 0, 1}};
  const View view = lit_view(sensor, 0);
  EXPECT_NEAR(laser_level(white_ground(), view, imaging, {0, 0, 0}, up), 420 * 0.8, 1e-9);  // incidence 3-4-5
  EXPECT_NEAR(laser_level(white_ground(), view, imaging, {0.6, 0, 0}, up), 420 * 0.8 * std::exp(-0.5), 0.001);
  EXPECT_EQ(laser_level(white_ground(), view, imaging, {4, 0, 0}, up), 0);
}

TEST(Render, StripesWidthIsThatOfSheetPixelAndLens) {
  const Imaging imaging = noise_free();
  const SimulatedSensor sensor = make_sensor(looking_down());
  const Image<float> image = rendered(white_ground(), lit_view(sensor, 0), imaging);
  double sum = 0, mean = 0, second = 0;
  for (int x = 0; x < image.width; ++x) {
    const double level = static_cast<double>(image(x, 120)) - 5;
    sum += level;
    mean += level * x;
    second += level * x * x;
  }
  mean /= sum;
  // 0.6 mm are 1.8 px; a pixel's width adds 1/12 px^2; 16 samples and the cut at 5 sigma leave less than
  // 1e-3.
  EXPECT_NEAR(second / sum - mean * mean, 1.8 * 1.8 + 0.7 * 0.7 + 1.0 / 12, 0.01);
  EXPECT_NEAR(mean, 159.5, 1e-3);
}

TEST(Render, SphereHidesWhatLiesBehindAndThrowsALaserShadow) {
  World world = white_ground();
  world.spheres.push_back({Vector3d(0, 0, 20), 10, {1, 0, 1}});
  const SimulatedSensor sensor = make_sensor(looking_down());
  const Image<float> image = rendered(world, lit_view(sensor, 0), noise_free());
  // In the plane x = 0 the source (-300, 400) sees the sphere's rim along two tangents that reach the ground
  // at y = 5.0 and y = 31.2 (tangent lines to a circle of radius 10 about (0, 20)). The camera sees the
  // ground there at 119.5 - 3 y, but down to y = 10.4 the sphere itself stands before it.
  const auto level = [&image](double y_mm) {
    return image(159, static_cast<int>(std::lround(119.5 - 3 * y_mm)));
  };
  EXPECT_LT(level(12), 6);
  EXPECT_LT(level(28), 6);
  EXPECT_GT(level(33), 150);
  EXPECT_GT(level(-15), 150);
}

/// Corners that OpenCV refines in the picture, against OpenCV's projection of the true ones.
struct CornerErrors {
  double mean = 0, rms = 0, worst = 0;
  Vector2d shift = Vector2d::Zero();
  bool same_order = false;
};

CornerErrors corner_errors(const SimulatedSensor& sensor, const BoardSurface& board, const Imaging& imaging) {
  World world;
  world.boards.push_back(board);
  const Image<float> light = rendered(world, {&sensor, Vector3d::Zero(), 215, false}, imaging);
  cv::Mat picture(light.height, light.width, CV_32F, const_cast<float*>(light.pixels.data()));
  cv::Mat grey;
  picture.convertTo(grey, CV_8U);
  const Rigid3 camera_from_board = sensor.world_from_camera.inverse() * board.world_from_board;
  std::vector<cv::Point3d> corners;
  for (int i = 0; i < board.target.num_corners(); ++i)
    corners.emplace_back(board.target.corner(i).x(), board.target.corner(i).y(), 0);
  cv::Mat R, rvec;
  cv::eigen2cv(Eigen::Matrix3d(camera_from_board.rotation.toRotationMatrix()), R);
  cv::Rodrigues(R, rvec);
  const Vector3d& t = camera_from_board.translation;
  const Camera& c = sensor.camera;
  const cv::Matx33d K(c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1);
  const std::vector<double> distortion(c.distortion.begin(), c.distortion.begin() + 5);
  std::vector<cv::Point2d> expected;
  cv::projectPoints(corners, rvec, cv::Vec3d(t.x(), t.y(), t.z()), K, distortion, expected);
  std::vector<cv::Point2f> found(expected.begin(), expected.end());
  cv::cornerSubPix(grey, found, {6, 6}, {-1, -1},
                   {cv::TermCriteria::EPS + cv::TermCriteria::COUNT, 100, 1e-4});
  CornerErrors out;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Vector2d error(found[i].x - expected[i].x, found[i].y - expected[i].y);
    out.mean += error.norm() / static_cast<double>(found.size());
    out.rms += error.squaredNorm() / static_cast<double>(found.size());
    out.worst = std::max(out.worst, error.norm());
    out.shift += error / static_cast<double>(found.size());
  }
  out.rms = std::sqrt(out.rms);
  std::vector<cv::Point2f> detected;
  const cv::Size size(board.target.columns, board.target.rows);
  if (cv::findChessboardCornersSB(grey, size, detected) && detected.size() == expected.size())
    out.same_order = cv::norm(detected.front() - cv::Point2f(expected.front())) < 1;
  return out;
}

TEST(Render, CheckerboardCornersLieWhereOpenCvProjectsThem) {
  const Scene scene;
  const auto sensors = make_sensors(scene);
  const auto poses = draw_board_poses(scene, sensors);
  for (std::size_t i = 0; i < 3; ++i)
    for (const SimulatedSensor& sensor : sensors) {
      const CornerErrors errors = corner_errors(sensor, make_board(scene.boards, poses[i]), noise_free());
      // Budget: 8-bit rounding of 160 levels of contrast 0.005 px, cornerSubPix on slanted corners about 0.02
      // px; a wrong pixel origin or a wrong distortion would show as a common shift of 0.5 px or more.
      EXPECT_LT(errors.mean, 0.03) << sensor.name << i;
      EXPECT_LT(errors.shift.norm(), 0.01) << sensor.name << i;
      EXPECT_TRUE(errors.same_order) << sensor.name << i;
    }
}

/// Rms and mean distance of the stripe's centroids, taken over each image column, from the traced line.
std::pair<double, double> centroid_errors(const SimulatedSensor& sensor, const World& world) {
  const Imaging imaging = noise_free();
  const View view = lit_view(sensor, 0);
  const Image<float> image = rendered(world, view, imaging);
  const auto truth = trace_stripe(world, view, imaging, 0.2);
  double square = 0, mean = 0;
  int columns = 0;
  for (std::size_t i = 20; i + 20 < truth.size(); ++i) {
    const Vector2d &a = truth[i].pixel, &b = truth[i + 1].pixel;
    const int x = static_cast<int>(std::ceil(std::min(a.x(), b.x())));
    if (x >= std::max(a.x(), b.x()) || std::abs(b.x() - a.x()) < std::abs(b.y() - a.y()) / 2) continue;
    const double y = a.y() + (x - a.x()) / (b.x() - a.x()) * (b.y() - a.y());
    double sum = 0, moment = 0;
    for (int row = static_cast<int>(y) - 29; row <= static_cast<int>(y) + 30; ++row) {
      sum += static_cast<double>(image(x, row)) - 5;
      moment += (static_cast<double>(image(x, row)) - 5) * (row - y);
    }
    square += moment / sum * moment / sum;
    mean += moment / sum;
    ++columns;
  }
  EXPECT_GT(columns, 100);
  return {std::sqrt(square / columns), mean / columns};
}

TEST(Render, StripesCentroidOnAPlaneLiesOnTheTracedLine) {
  Scene scene;
  scene.boards.black_albedo = scene.boards.white_albedo;
  const auto sensors = make_sensors(scene);
  const auto poses = draw_board_poses(scene, sensors);
  for (std::size_t i = 0; i < 3; ++i)
    for (const SimulatedSensor& sensor : sensors) {
      World world;
      world.boards.push_back(make_board(scene.boards, poses[i]));
      const auto [rms, mean] = centroid_errors(sensor, world);
      // Light falls off along the slanted sheet and the sheet's picture is perspective: a few thousandths of
      // a pixel.
      EXPECT_LT(rms, 0.02) << sensor.name << i;
      EXPECT_LT(std::abs(mean), 0.01) << sensor.name << i;
      RecordProperty(sensor.name + std::to_string(i), std::to_string(rms));
    }
}

TEST(Render, MoreSamplesDoNotMoveTheStripe) {
  Imaging coarse = noise_free(), fine = noise_free();
  fine.samples = 256;
  const SimulatedSensor sensor = make_sensor(SceneSensor{});
  World world;
  world.ground = GroundObject{-75, {0.6, 0, 1}};
  const View view = lit_view(sensor, 0);
  const Image<float> a = rendered(world, view, coarse), b = rendered(world, view, fine);
  float worst = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    worst = std::max(worst, std::abs(a.pixels[i] - b.pixels[i]));
  EXPECT_LT(worst, 0.25F);  // levels, of a stripe of about 150: rounding to 8 bits is coarser
}

}  // namespace
}  // namespace lightstripe
