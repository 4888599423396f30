// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "core/camera.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <opencv2/calib3d.hpp>
#include <string>
#include <vector>

#include "core/random.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

struct NamedCamera {
  std::string name;
  Camera camera;
};

std::ostream& operator<<(std::ostream& out, const NamedCamera& c) { return out << c.name; }

Camera camera_with(const std::array<double, kDistortionTerms>& distortion) {
  return {960, 700, 1640, 1632, 471.3, 352.8, distortion};
}

std::vector<NamedCamera> cameras() {
  return {
      {"pinhole", camera_with({})},
      {"five_terms", camera_with({-0.21, 0.12, 6e-4, -4e-4, -0.05})},
      {"rational", camera_with({0.31, -0.22, 5e-4, 3e-4, 0.07, 0.48, -0.11, 0.09})},
      {"thin_prism",
       camera_with({-0.1, 0.05, 4e-4, -2e-4, 0.01, 0.02, -0.01, 0.005, 2e-3, -1e-3, -3e-3, 5e-4})},
      {"tilted", camera_with({-0.15, 0.08, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.14, -0.09})},
      {"all", camera_with({-0.1, 0.05, 4e-4, -2e-4, 0.01, 0.02, -0.01, 0.005, 2e-3, -1e-3, -3e-3, 5e-4, -0.07,
                           0.21})},
  };
}

std::vector<Vector3d> points_in_view() {
  Random random(7);
  std::vector<Vector3d> points;
  for (int i = 0; i < 400; ++i) {
    const double z = random.uniform(300, 900);
    points.emplace_back(z * random.uniform(-0.3, 0.3), z * random.uniform(-0.22, 0.22), z);
  }
  return points;
}

class CameraModels : public testing::TestWithParam<NamedCamera> {};

INSTANTIATE_TEST_SUITE_P(All, CameraModels, testing::ValuesIn(cameras()),
                         [](const auto& instance) { return instance.param.name; });

TEST_P(CameraModels, ProjectAgreesWithOpenCv) {
  const Camera& camera = GetParam().camera;
  std::vector<cv::Point3d> cv_points;
  for (const auto& p : points_in_view()) cv_points.emplace_back(p.x(), p.y(), p.z());
  const cv::Matx33d K(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  const std::vector<double> distortion(camera.distortion.begin(), camera.distortion.end());
  std::vector<cv::Point2d> expected;
  cv::projectPoints(cv_points, cv::Vec3d(), cv::Vec3d(), K, distortion, expected);

  const auto points = points_in_view();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto pixel = project(camera, points[i]);
    ASSERT_TRUE(pixel);
    // Both evaluate the same formula in double: only rounding (1e3 px * 1e-16 * some ten operations) may
    // differ.
    EXPECT_NEAR(pixel->x(), expected[i].x, 1e-10);
    EXPECT_NEAR(pixel->y(), expected[i].y, 1e-10);
  }
}

TEST_P(CameraModels, ProjectUndoesUnprojectTo1em9Px) {
  const Camera& camera = GetParam().camera;
  for (int y = -20; y <= camera.height + 20; y += 20) {
    for (int x = -20; x <= camera.width + 20; x += 20) {
      const Vector2d pixel(x + 0.123, y - 0.456);
      const auto ray = unproject(camera, pixel);
      ASSERT_TRUE(ray) << pixel.transpose();
      EXPECT_LT((*project(camera, 500.0 * *ray) - pixel).norm(), 1e-9) << pixel.transpose();
    }
  }
}

TEST_P(CameraModels, UnprojectReturnsTheRayThatWasProjected) {
  const Camera& camera = GetParam().camera;
  for (const auto& p : points_in_view()) {
    const auto ray = unproject(camera, *project(camera, p));
    ASSERT_TRUE(ray);
    EXPECT_LT((p.z() * *ray - p).norm(), 1e-9);  // mm at < 1 m: 1e-12 of the range
  }
}

TEST_P(CameraModels, JacobianIsTheDerivativeOfProject) {
  const Camera& camera = GetParam().camera;
  const double h =
      1e-6;  // central differences: truncation h^2 * f''' ~ 1e-9, rounding 1e3 * 1e-16 / h ~ 1e-7 px
  for (const auto& p : points_in_view()) {
    const Vector2d at = p.head<2>() / p.z();
    const auto J = projection_jacobian(camera, at);
    for (int i = 0; i < 2; ++i) {
      const Vector2d step = h * Vector2d::Unit(i);
      const Vector2d ahead = *project(camera, (at + step).homogeneous());
      const Vector2d behind = *project(camera, (at - step).homogeneous());
      EXPECT_LT((J.col(i) - (ahead - behind) / (2 * h)).norm(), 2e-6);
    }
  }
}

TEST_P(CameraModels, IsInvertibleOverItsImage) { EXPECT_TRUE(invertible_over_image(GetParam().camera)); }

TEST(Camera, HandComputedPinholePixel) {
  const Camera camera{640, 480, 1000, 800, 320, 240, {}};
  // x = 1000 * 10 / 500 + 320 = 340, y = 800 * -5 / 500 + 240 = 232
  EXPECT_EQ(*project(camera, {10, -5, 500}), Vector2d(340, 232));
  EXPECT_EQ(*unproject(camera, {340, 232}), Vector3d(0.02, -0.01, 1));
}

TEST(Camera, HandComputedRadialDistortion) {
  Camera camera{640, 480, 1000, 1000, 320, 240, {}};
  camera.distortion[0] = -0.5;
  // r^2 = 0.25, factor 1 - 0.125 = 0.875: (0.3, 0.4) -> (0.2625, 0.35)
  EXPECT_LT((*project(camera, {0.3, 0.4, 1}) - Vector2d(582.5, 590)).norm(), 1e-12 * 1e3);
}

TEST(Camera, PointBehindTheCameraHasNoPixel) {
  const Camera camera = camera_with({});
  EXPECT_FALSE(project(camera, {1, 2, 0}));
  EXPECT_FALSE(project(camera, {1, 2, -5}));
}

TEST(Camera, PixelBeyondTheFoldHasNoRay) {
  Camera camera{2000, 2000, 1000, 1000, 1000, 1000, {}};
  camera.distortion[0] = -0.5;
  // r (1 - r^2 / 2) has its maximum at r = sqrt(2/3): 0.5443, so no light falls beyond 544.3 px from the
  // centre.
  EXPECT_TRUE(unproject(camera, {1000 + 540, 1000}));
  EXPECT_FALSE(unproject(camera, {1000 + 545, 1000}));
  EXPECT_FALSE(unproject(camera, {1000 + 5000, 1000}));
  EXPECT_FALSE(invertible_over_image(camera));
}

TEST(Camera, TheFoldedBranchIsNeverTaken) {
  Camera camera{2000, 2000, 1000, 1000, 1000, 1000, {}};
  camera.distortion[0] = -1.0, camera.distortion[1] = 0.3;
  // g(r) = r - r^3 + 0.3 r^5: g' = 1 - 3 r^2 + 1.5 r^4 is zero at r = 0.6502 and 1.2559; in between the
  // picture runs backwards, beyond it forwards again. Only the first branch, up to g(0.6502) = 0.4101, is
  // where light comes from.
  for (int px = 0; px < 3000; px += 7) {
    const auto ray = unproject(camera, {1000.0 + px, 1000.0});
    if (px < 409) {
      ASSERT_TRUE(ray) << px;
      EXPECT_LT(ray->x(), 0.6502);
    } else if (px > 411) {
      EXPECT_FALSE(ray) << px << " -> " << ray->transpose();
    }
  }
}

TEST(Camera, NotANumberHasNoRay) {
  EXPECT_FALSE(unproject(camera_with({-0.2}), {std::nan(""), 10}));
  EXPECT_FALSE(project(camera_with({-0.2}), {1, 1, std::nan("")}));
}

}  // namespace
}  // namespace lightstripe
