// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/sheet_thickness.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace lightstripe {
namespace {

using Eigen::Vector3d;

TEST(SheetThickness, FollowsFromTheLinesWidth) {
  Camera camera;
  camera.fx = camera.fy = 1600;
  // The plane's normal 50 degrees from the view: 1 mm along it is seen as sin 50 mm. At 500 mm and 1600 px
  // that is 2.45 px; the bar of a gaussian of sigma s has the width 2 sqrt(3) s.
  const double slant = 50 * 3.14159265358979 / 180;
  const Plane plane{{std::sin(slant), 0, std::cos(slant)}, 300};
  const double sigma_px = 0.6 * std::sin(slant) * 1600 / 500;
  const auto sigma =
      sheet_sigma_mm(camera, plane, {0, 0, 500}, 2 * std::sqrt(3.0) * std::hypot(sigma_px, 0.57));
  ASSERT_TRUE(sigma);
  EXPECT_NEAR(*sigma, 0.6, 1e-9);
  EXPECT_FALSE(sheet_sigma_mm(camera, {{0, 0, 1}, 500}, {0, 0, 500}, 5));
}

// By hand and without this code: a ball of 40 mm rendered pixel by pixel, its ridges by Steger's formula, a
// sphere by least squares. The sheet's part of the error was 0.11 mm at a sigma of 0.6 mm and 0.27 at 1.0;
// evenly scattering surfaces 0.18 and 0.34. `simulate` and `verify`: 0.156 and 0.427.
TEST(SheetThickness, MakesABallSmallByAsMuchAsTwoRenderersSay) {
  const Vector3d ball = Vector3d::Zero(), travel = Vector3d::UnitX();
  for (const auto& [t, least, most] : {std::array{0.6, 0.11, 0.18}, std::array{1.0, 0.27, 0.43}}) {
    EXPECT_GT(sheet_error_mm(t, 40, ball, travel), least);
    EXPECT_LT(sheet_error_mm(t, 40, ball, travel), most);
  }
}

TEST(SheetThickness, ACylinderAlongTheTravelIsStraightAcrossTheSheet) {
  const Vector3d travel = Vector3d::UnitX();
  EXPECT_NEAR(sheet_error_mm(1, 40, travel, travel), 0, 1e-12);
  EXPECT_EQ(sheet_error_mm(1, 40, Vector3d::UnitY(), travel),
            sheet_error_mm(1, 40, Vector3d::Zero(), travel));
}

}  // namespace
}  // namespace lightstripe
