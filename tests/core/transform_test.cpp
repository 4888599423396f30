// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "core/transform.h"

#include <gtest/gtest.h>

#include <numbers>

namespace lightstripe {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;

TEST(Rigid3, QuarterTurnAboutZThenShift) {
  const Rigid3 a_from_b{Quaterniond(AngleAxisd(kPi / 2, Vector3d::UnitZ())), {10, 20, 30}};
  EXPECT_LT((a_from_b * Vector3d(1, 0, 0) - Vector3d(10, 21, 30)).norm(), 1e-14);
}

TEST(Rigid3, ProductAppliesTheRightFactorFirst) {
  const Rigid3 a_from_b{Quaterniond(AngleAxisd(0.7, Vector3d(1, 2, 3).normalized())), {5, -3, 8}};
  const Rigid3 b_from_c{Quaterniond(AngleAxisd(-1.2, Vector3d(-2, 1, 0.5).normalized())), {100, 40, -7}};
  const Vector3d p(12, -34, 56);
  EXPECT_LT(((a_from_b * b_from_c) * p - a_from_b * (b_from_c * p)).norm(), 1e-12);
}

TEST(Rigid3, InverseUndoesTheTransform) {
  const Rigid3 a_from_b{Quaterniond(AngleAxisd(2.9, Vector3d(1, -1, 0.2).normalized())), {500, -300, 80}};
  const Vector3d p(12, -34, 56);
  EXPECT_LT((a_from_b.inverse() * (a_from_b * p) - p).norm(), 1e-12);
}

TEST(RotationAngle, IsTheSameForBothSignsOfTheQuaternion) {
  for (const double angle : {0.0, 1e-9, 0.3, 3.1, kPi}) {
    Quaterniond q(AngleAxisd(angle, Vector3d(2, 1, -1).normalized()));
    EXPECT_NEAR(rotation_angle(q), angle, 1e-15);
    q.coeffs() *= -1;
    EXPECT_NEAR(rotation_angle(q), angle, 1e-15);
  }
  EXPECT_NEAR(rotation_angle(Quaterniond(AngleAxisd(1.5 * kPi, Vector3d::UnitY()))), 0.5 * kPi, 1e-14);
}

}  // namespace
}  // namespace lightstripe
