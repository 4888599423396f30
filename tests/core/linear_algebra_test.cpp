// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "core/linear_algebra.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace lightstripe {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;

TEST(LinearAlgebra, EigenvaluesRise) {
  const SymmetricEigen eigen = symmetric_eigen(Matrix2d{{2, 1}, {1, 2}});
  EXPECT_NEAR(eigen.values[0], 1, 1e-12);
  EXPECT_NEAR(eigen.values[1], 3, 1e-12);
  EXPECT_NEAR(std::abs(eigen.vectors.col(1).dot(Vector2d(1, 1)) / std::sqrt(2.0)), 1, 1e-12);
}

TEST(LinearAlgebra, LeastSquaresIsTheMeanAndTheShortestOfMany) {
  EXPECT_NEAR(solve_least_squares(Vector3d(1, 1, 1), Vector3d(1, 2, 6))(0, 0), 3, 1e-12);
  const MatrixXd x = solve_least_squares(MatrixXd{{1, 1}}, MatrixXd{{2}});  // x + y = 2
  EXPECT_NEAR(x(0, 0), 1, 1e-12);
  EXPECT_NEAR(x(1, 0), 1, 1e-12);
}

TEST(LinearAlgebra, SolvesSymmetricSystems) {
  const Vector2d x = solve_symmetric(Matrix2d{{4, 1}, {1, 3}}, Vector2d(1, 2));
  EXPECT_NEAR(x.x(), 1.0 / 11, 1e-12);
  EXPECT_NEAR(x.y(), 7.0 / 11, 1e-12);
}

TEST(LinearAlgebra, TheRootGivesTheMatrixBack) {
  const Matrix3d A{{4, 2, 0}, {2, 3, 1}, {0, 1, 2}};
  const MatrixXd M = symmetric_root(A);
  EXPECT_LT((M * M.transpose() - A).norm(), 1e-12);
  // One direction is known exactly; rounding may leave it a little below 0.
  const Matrix2d flat{{1, 1}, {1, 1}};
  const MatrixXd root = symmetric_root(flat);
  EXPECT_TRUE(root.allFinite());
  EXPECT_LT((root * root.transpose() - flat).norm(), 1e-12);
}

TEST(LinearAlgebra, ASingularMatrixHasNoInverse) {
  EXPECT_FALSE(inverse_of(Matrix2d{{1, 2}, {2, 4}}));
  const auto inverse = inverse_of(Matrix2d{{2, 1}, {1, 1}});
  ASSERT_TRUE(inverse);
  EXPECT_LT((*inverse - Matrix2d{{1, -1}, {-1, 2}}).norm(), 1e-12);
  EXPECT_FALSE(inverse_of(Matrix2d{{1, 0}, {0, 1e-13}}, 1e-12));
}

TEST(LinearAlgebra, TheBasisSpansTheColumns) {
  const MatrixXd A{{1, 1}, {1, 2}, {1, 4}};
  const MatrixXd Q = orthonormal_basis(A);
  EXPECT_LT((Q.transpose() * Q - MatrixXd::Identity(2, 2)).norm(), 1e-12);
  EXPECT_LT((Q * (Q.transpose() * A) - A).norm(), 1e-12);
}

TEST(LinearAlgebra, TheNearestRotationOfAScaledOneIsItself) {
  const Matrix3d R = Eigen::AngleAxisd(0.7, Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  EXPECT_LT((nearest_rotation(3 * R) - R).norm(), 1e-12);
  // What is stretched symmetrically about the rotation stays it.
  EXPECT_LT((nearest_rotation(R * Vector3d(1, 1.1, 0.9).asDiagonal()) - R).norm(), 1e-12);
}

}  // namespace
}  // namespace lightstripe
