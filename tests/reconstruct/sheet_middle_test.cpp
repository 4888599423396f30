// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/sheet_middle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>

#include "core/random.h"

namespace lightstripe {
namespace {

const Camera kCamera{640, 480, 1000, 1000, 320, 240, {}};

/// In the picture's middle the plane's normal points along (x, y).
Plane plane_along(double x, double y) {
  const Eigen::Vector3d normal = Eigen::Vector3d(x, y, 1).normalized();
  return {normal, normal.z() * 500};
}
const Plane kOblique = plane_along(1, 1);

constexpr int kLength = 121;                  // points, the middle one in the picture's middle
constexpr std::size_t kMiddle = kLength / 2;  // y = 240
constexpr double kBlur = 0.64;                // px^2, of lens and pixels
constexpr double kVariance = 3.5;             // px^2, of the sheet's light along d = (1, 1) / sqrt(2)

/// A line that runs down the picture; centre and strength by the rows from the middle on.
std::vector<StripePoint> line_of(const std::function<double(double)>& centre,
                                 const std::function<double(double)>& strength) {
  std::vector<StripePoint> line;
  for (int k = 0; k < kLength; ++k) {
    const double y = k - static_cast<double>(kMiddle), slope = centre(y + 0.5) - centre(y - 0.5);
    StripePoint p;
    p.x = 320 + centre(y), p.y = 240 + y;
    p.normal_x = 1 / std::hypot(1.0, slope), p.normal_y = -slope / std::hypot(1.0, slope);
    p.width = std::sqrt(12 * (kVariance * std::pow(p.normal_x + p.normal_y, 2) / 2 + kBlur));
    p.strength = strength(y);
    line.push_back(p);
  }
  return line;
}
double straight(double) { return 0; }
double even(double) { return 10; }
double fading(double y) { return 10 * std::exp(0.03 * y); }
double bent(double y) { return -y * y / 120; }  // radius 60 px

std::vector<double> shifts_of(const std::vector<StripePoint>& line, const Plane& plane = kOblique) {
  std::vector<SheetShift> found;
  find_sheet_shifts(kCamera, plane, line, found);
  EXPECT_EQ(found.size(), line.size());
  std::vector<double> shifts;
  for (const SheetShift& shift : found) shifts.push_back(shift.px);
  return shifts;
}

/// Where row 0 sees the middle of the light: layers of the sheet, each the whole line moved along d.
double middle_of_light(double (*centre)(double), double (*strength)(double)) {
  const double d = std::sqrt(0.5), s = std::sqrt(kVariance);
  double light = 0, moment = 0;
  for (double t = -6 * s; t <= 6 * s; t += 0.01 * s) {
    const double y = -t * d, weight = std::exp(-0.5 * t * t / kVariance) * strength(y);
    light += weight;
    moment += weight * (centre(y) + t * d);
  }
  return moment / light;
}

TEST(SheetMiddle, FadingLightAndBendsAreUndone) {
  EXPECT_NEAR(shifts_of(line_of(straight, fading))[kMiddle], 0.5 * kVariance * 0.03, 1e-3);
  EXPECT_NEAR(shifts_of(line_of(straight, fading))[kMiddle], -middle_of_light(straight, fading), 1e-3);
  EXPECT_NEAR(shifts_of(line_of(bent, even))[kMiddle], 0.25 * kVariance / 60, 1e-3);
  EXPECT_NEAR(shifts_of(line_of(bent, even))[kMiddle], -middle_of_light(bent, even), 1e-3);
}

TEST(SheetMiddle, APointMovesToTheSamePlaceWhicheverWayItsNormalPoints) {
  auto line = line_of(straight, fading);
  const double shift = shifts_of(line)[kMiddle];
  for (StripePoint& p : line) p.normal_x = -p.normal_x, p.normal_y = -p.normal_y;
  EXPECT_NEAR(shifts_of(line)[kMiddle], -shift, 5e-4);
  std::ranges::reverse(line);
  EXPECT_NEAR(shifts_of(line)[kMiddle], -shift, 5e-4);
  EXPECT_NEAR(shifts_of(line, {-kOblique.normal, -kOblique.offset})[kMiddle], -shift, 5e-4);
}

TEST(SheetMiddle, NothingMovesWhereNothingTells) {
  const auto all_are_zero = [](const std::vector<double>& shifts) {
    return std::ranges::all_of(shifts, [](double shift) { return std::abs(shift) < 1e-9; });
  };
  EXPECT_TRUE(all_are_zero(shifts_of(line_of(straight, even))));
  // Seen square to the line, and along it.
  EXPECT_NEAR(shifts_of(line_of(straight, fading), plane_along(1, 0))[kMiddle], 0, 1e-6);
  EXPECT_TRUE(all_are_zero(shifts_of(line_of(straight, fading), plane_along(0.2, 1))));
  EXPECT_TRUE(all_are_zero(shifts_of({})));
  auto line = line_of(straight, fading);
  for (StripePoint& p : line) p.flags = kStripeSaturated;
  EXPECT_TRUE(all_are_zero(shifts_of(line)));
  for (StripePoint& p : line) p.flags = 0, p.width = 1.5;  // no wider than lens and pixels
  EXPECT_TRUE(all_are_zero(shifts_of(line)));
}

TEST(SheetMiddle, EndsGapsAndBridgesStay) {
  auto line = line_of(straight, fading);
  line[40].flags = kStripeBridged;
  for (std::size_t k = 80; k < line.size(); ++k) line[k].y += 10;
  const auto shifts = shifts_of(line);
  for (const std::size_t k : {0, 4, 40, 79, 80, 117, 120}) EXPECT_EQ(shifts[k], 0) << k;
  for (const std::size_t k : {20, 60, 100}) EXPECT_GT(shifts[k], 0.02) << k;
}

/// Light that fades by half of its slope across the line, of which the sheet's part is undone.
TEST(SheetMiddle, SigmaLosesWhatTheSheetTells) {
  auto line = line_of(straight, fading);
  for (StripePoint& p : line) p.sigma_px = 0.05, p.fade_px = 0.04F;  // 0.03 by all else
  std::vector<SheetShift> shifts;
  find_sheet_shifts(kCamera, kOblique, line, shifts);
  const StripePoint told = in_sheet_middle(line[kMiddle], shifts[kMiddle]);
  EXPECT_NEAR(told.sigma_px, std::hypot(0.03, 0.02), 1e-6);
  EXPECT_EQ(told.x, line[kMiddle].x + shifts[kMiddle].px);
  EXPECT_EQ(in_sheet_middle(line[0], shifts[0]).sigma_px, 0.05);  // at the end nothing is told
  find_sheet_shifts(kCamera, plane_along(0.2, 1), line, shifts);  // nor along the sheet
  EXPECT_EQ(in_sheet_middle(line[kMiddle], shifts[kMiddle]).sigma_px, 0.05);
}

/// Grain makes strengths go up and down like fading light, and tells nothing of the sheet.
TEST(SheetMiddle, GrainIsNoFading) {
  Random random(3);
  std::vector<double> noise;
  for (int k = 0; k < kLength + 20; ++k) noise.push_back(random.gaussian());
  const auto grained = [&](double y) {
    double sum = 0;  // over the kernel's length
    for (int k = 0; k < 10; ++k)
      sum += noise[static_cast<std::size_t>(y + kMiddle) + static_cast<std::size_t>(k)];
    return 10 * std::exp(0.05 * sum);
  };
  double squares = 0, trusting = 0;
  const auto line = line_of(straight, grained);
  const auto shifts = shifts_of(line);
  for (std::size_t k = 10; k + 10 < line.size(); ++k) {
    squares += shifts[k] * shifts[k];
    const double change = std::log(line[k + 5].strength / line[k - 5].strength) / 10;
    trusting += std::pow(0.5 * kVariance * change, 2);
  }
  EXPECT_LT(squares, 0.5 * trusting);
  EXPECT_GT(trusting, 0);
}

}  // namespace
}  // namespace lightstripe
