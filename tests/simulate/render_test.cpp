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
#include "simulate/exposure.h"
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
  const Image<float> image = rendered(white_ground(), {&sensor, {}, 100, 0}, imaging);
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

/// Pixels of points of the board's plane, by OpenCV.
std::vector<cv::Point2d> projected(const SimulatedSensor& sensor, const BoardSurface& board,
                                   const std::vector<cv::Point3d>& on_board) {
  const Rigid3 camera_from_board = sensor.world_from_camera.inverse() * board.world_from_board;
  cv::Mat R, rvec;
  cv::eigen2cv(Eigen::Matrix3d(camera_from_board.rotation.toRotationMatrix()), R);
  cv::Rodrigues(R, rvec);
  const Vector3d& t = camera_from_board.translation;
  const Camera& c = sensor.camera;
  const cv::Matx33d K(c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1);
  const std::vector<double> distortion(c.distortion.begin(), c.distortion.begin() + 5);
  std::vector<cv::Point2d> pixels;
  cv::projectPoints(on_board, rvec, cv::Vec3d(t.x(), t.y(), t.z()), K, distortion, pixels);
  return pixels;
}

Image<float> board_image(const SimulatedSensor& sensor, const BoardSurface& board) {
  World world;
  world.boards.push_back(board);
  return rendered(world, {&sensor, {}, 215, 0}, noise_free());
}

/// Where an edge crosses an image column near a row: the column's light from `reach` px above to `reach`
/// below tells how much of it is bright, whatever the blur.
double edge_row(const Image<float>& image, int x, int row, int reach) {
  const double above = image(x, row - reach), below = image(x, row + reach);
  double sum = 0;
  for (int y = row - reach; y <= row + reach; ++y) sum += static_cast<double>(image(x, y)) - below;
  return row - reach - 0.5 + sum / (above - below);
}

TEST(Render, CheckerboardEdgesLieWhereOpenCvProjectsThem) {
  const Scene scene;
  const auto sensors = make_sensors(scene);
  const auto poses = draw_board_poses(scene, sensors);
  double square = 0, sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const SimulatedSensor& sensor = sensors[i % 2];
    const BoardSurface board = make_board(scene.boards, poses[i]);
    const Image<float> image = board_image(sensor, board);
    for (int n = 0; n < board.target.num_corners() - 1; ++n) {
      if ((n + 1) % board.target.columns == 0) continue;
      const Vector2d corner =
          board.target.corner(n);  // the middle part of the edge that runs from it along x
      const auto ends =
          projected(sensor, board, {{corner.x() + 4, corner.y(), 0}, {corner.x() + 6, corner.y(), 0}});
      const int x = static_cast<int>(std::lround(0.5 * (ends[0].x + ends[1].x)));
      const double slope = (ends[1].y - ends[0].y) / (ends[1].x - ends[0].x);
      if (std::abs(slope) > 0.6) continue;
      const double expected = ends[0].y + (x - ends[0].x) * slope;
      const double error = edge_row(image, x, static_cast<int>(std::lround(expected)), 6) - expected;
      square += error * error;
      sum += error;
      ++count;
    }
  }
  EXPECT_GT(count, 60);
  // Sixty-four samples place an edge in a pixel to about 0.01 px; rays between grid points are good to 2e-5
  // px.
  EXPECT_LT(std::sqrt(square / count), 0.01);
  EXPECT_LT(std::abs(sum / count), 0.002);
}

/// Corners that OpenCV refines in the picture, against OpenCV's projection of the true ones.
struct CornerErrors {
  double mean = 0;
  Vector2d shift = Vector2d::Zero();
  bool same_order = false;  ///< OpenCV's detector begins at the corner that the board's frame begins at
};

CornerErrors corner_errors(const SimulatedSensor& sensor, const BoardSurface& board) {
  const Image<float> light = board_image(sensor, board);
  const Image8 image = expose(light, noise_free(), 1, 1);
  const cv::Mat grey(image.height, image.width, CV_8U, const_cast<std::uint8_t*>(image.pixels.data()));
  std::vector<cv::Point3d> corners;
  for (int i = 0; i < board.target.num_corners(); ++i)
    corners.emplace_back(board.target.corner(i).x(), board.target.corner(i).y(), 0);
  const auto expected = projected(sensor, board, corners);
  std::vector<cv::Point2f> found(expected.begin(), expected.end());
  cv::cornerSubPix(grey, found, {6, 6}, {-1, -1},
                   {cv::TermCriteria::EPS + cv::TermCriteria::COUNT, 100, 1e-4});
  CornerErrors out;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Vector2d error(found[i].x - expected[i].x, found[i].y - expected[i].y);
    out.mean += error.norm() / static_cast<double>(found.size());
    out.shift += error / static_cast<double>(found.size());
  }
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
  for (std::size_t i = 0; i < 1; ++i)
    for (const SimulatedSensor& sensor : sensors) {
      const CornerErrors errors = corner_errors(sensor, make_board(scene.boards, poses[i]));
      // cornerSubPix itself is good to 0.02 to 0.03 px on slanted corners (the same with 256 samples a
      // pixel); a wrong pixel origin or distortion would show as a common shift of 0.5 px or more.
      EXPECT_LT(errors.mean, 0.035) << sensor.name << i;
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
  for (std::size_t i = 200; i + 200 < truth.size(); ++i) {  // 40 px from the board's rim
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
  EXPECT_GT(columns, 50);
  return {std::sqrt(square / columns), mean / columns};
}

TEST(Render, StripesCentroidOnAPlaneLiesOnTheTracedLine) {
  Scene scene;
  scene.boards.black_albedo = scene.boards.white_albedo;
  const auto sensors = make_sensors(scene);
  const auto poses = draw_board_poses(scene, sensors);
  for (std::size_t i = 0; i < 2; ++i)
    for (const SimulatedSensor& sensor : sensors) {
      World world;
      world.boards.push_back(make_board(scene.boards, poses[i]));
      const auto [rms, mean] = centroid_errors(sensor, world);
      // The sheet is 0.6 mm thick and its picture is perspective: on a slanted board one flank is a few parts
      // in a thousand wider than the other, which moves the centroid by up to 0.015 px; a wrong geometry
      // moves it by more.
      EXPECT_LT(rms, 0.02) << sensor.name << i;
      EXPECT_LT(std::abs(mean), 0.02) << sensor.name << i;
    }
}

TEST(Render, MoreSamplesDoNotMoveTheStripe) {
  Imaging coarse = noise_free(), fine = noise_free();
  fine.samples = 256;
  SceneSensor slanted = looking_down();
  slanted.laser.source = {150, -260, 400};
  slanted.laser.normal = {1, 0.577, 0};  // 30 degrees against the pixels' columns
  const SimulatedSensor sensor = make_sensor(slanted);
  const World world = white_ground();
  const View view = lit_view(sensor, 0);
  const Image<float> a = rendered(world, view, coarse), b = rendered(world, view, fine);
  float worst = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    worst = std::max(worst, std::abs(a.pixels[i] - b.pixels[i]));
  EXPECT_LT(worst, 0.3F);  // levels, of a stripe of about 300: rounding to 8 bits is coarser
}

}  // namespace
}  // namespace lightstripe
