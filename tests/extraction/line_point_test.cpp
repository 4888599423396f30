// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/follow/line_point.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "core/random.h"

namespace lightstripe {
namespace {

TEST(HessianAxes, AgreeWithEigen) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    Derivatives d;
    d.dxx = static_cast<float>(random.gaussian());
    d.dyy = static_cast<float>(random.gaussian());
    d.dxy = static_cast<float>(i % 10 == 0 ? 0.0 : random.gaussian());
    Eigen::Matrix2d h;
    h << d.dxx, d.dxy, d.dxy, d.dyy;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(h);
    const int largest = std::abs(solver.eigenvalues()[0]) > std::abs(solver.eigenvalues()[1]) ? 0 : 1;
    const HessianAxes axes = hessian_axes(d);
    EXPECT_NEAR(axes.across, solver.eigenvalues()[largest], 1e-6);
    EXPECT_NEAR(axes.along, solver.eigenvalues()[1 - largest], 1e-6);
    const Eigen::Vector2d n = solver.eigenvectors().col(largest);
    EXPECT_NEAR(std::abs(n.x() * axes.normal_x + n.y() * axes.normal_y), 1.0, 1e-6);
  }
}

TEST(HessianAxes, OfAFlatSurfaceIsSomeUnitVector) {
  const HessianAxes axes = hessian_axes({});
  EXPECT_DOUBLE_EQ(std::hypot(axes.normal_x, axes.normal_y), 1.0);
  EXPECT_EQ(axes.across, 0);
}

TEST(RidgeOffset, FindsTheTopOfAParabola) {
  // r = 10 - (u - 0.3)^2 along n = (0.6, 0.8), seen from u = 0: r' = 0.6, r'' = -2.
  Derivatives d;
  d.dx = 0.6F * 0.6F;
  d.dy = 0.6F * 0.8F;
  d.dxx = -2 * 0.36F;
  d.dxy = -2 * 0.48F;
  d.dyy = -2 * 0.64F;
  const HessianAxes axes = hessian_axes(d);
  EXPECT_NEAR(axes.across, -2, 1e-6);
  const double t = ridge_offset(d, axes.normal_x, axes.normal_y, axes.across);
  EXPECT_NEAR(t * axes.normal_x, 0.3 * 0.6, 1e-6);
  EXPECT_NEAR(t * axes.normal_y, 0.3 * 0.8, 1e-6);
}

TEST(CentreSigma, OfAMatchedStripeIsTheClosedFormula) {
  // sigma = s: 0.564 noise / A for a strength of A / (2 sqrt(2) sigma^2); pixel integration widens the kernel
  // a little.
  const DerivativeKernels kernels = make_derivative_kernels(3.0);
  EXPECT_NEAR(centre_sigma(kernels, 2.0, 100 * kernels.matched_strength()), 0.564 * 2.0 / 100, 0.0003);
}

}  // namespace
}  // namespace lightstripe
