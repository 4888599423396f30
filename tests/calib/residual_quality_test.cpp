// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "calib/assess/verdict.h"

namespace lightstripe {
namespace {

/// Sensor `a` with two views, `b` with one that shows a height only.
SessionViews two_sensors() {
  SessionViews session;
  session.sensor_names = {"a", "b"};
  session.views.resize(3);
  session.views[0].image = "1.png", session.views[1].image = "2.png", session.views[2].image = "3.png";
  session.views[0].stripes = {std::vector<StripePoint>(4)};
  session.views[1].stripes = {{}};
  session.views[2].sensor = 1, session.views[2].height_mm = 20,
  session.views[2].stripes = {std::vector<StripePoint>(1)};
  return session;
}

Residual residual(std::size_t view, int plane, double x, double y, bool used = true) {
  Residual out;
  out.view = view, out.plane = plane, out.residual_px = {x, y}, out.used = used;
  return out;
}

const std::vector<Residual> kList{residual(0, -1, 3, 4),  residual(0, -1, 0, 0),        residual(0, 0, 2, 0),
                                  residual(0, 0, -2, 0),  residual(0, 0, 90, 0, false), residual(1, -1, 0, 1),
                                  residual(2, 0, -0.5, 0)};

TEST(ViewResiduals, CornersCountByTheirLengthOutliersNot) {
  const auto views = view_residuals(two_sensors(), kList);
  ASSERT_EQ(views.size(), 3U);
  EXPECT_EQ(views[0].sensor, "a");
  EXPECT_EQ(views[0].image, "1.png");
  EXPECT_NEAR(views[0].board_rms_px, std::sqrt(25.0 / 2), 1e-12);
  EXPECT_NEAR(views[0].stripe_rms_px, 2, 1e-12);
  EXPECT_EQ(views[0].corners, 2);
  EXPECT_EQ(views[0].stripe_points, 2);
  EXPECT_EQ(views[0].left_out, 1);
  EXPECT_EQ(views[1].stripe_rms_px, 0);  // none
  EXPECT_EQ(views[2].sensor, "b");
}

TEST(SensorQualities, SumTheViewsOfASensor) {
  const auto sensors = sensor_quality(two_sensors(), kList);
  ASSERT_EQ(sensors.size(), 2U);
  EXPECT_NEAR(sensors[0].board_rms_px, std::sqrt(26.0 / 3), 1e-12);
  EXPECT_EQ(sensors[0].board_views, 2);
  EXPECT_EQ(sensors[0].stripe_views, 1);
  EXPECT_NEAR(sensors[1].stripe_rms_px, 0.5, 1e-12);
  EXPECT_EQ(sensors[1].board_views, 0);  // a height is no board
  EXPECT_EQ(sensors[1].stripe_views, 1);
}

}  // namespace
}  // namespace lightstripe
