// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Decompositions of small matrices, compiled once: a file that instantiates Eigen's own compiles three times
// as long. Not for loops over points or pixels, because each call allocates.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace lightstripe {

struct SymmetricEigen {
  Eigen::VectorXd values;   ///< rising
  Eigen::MatrixXd vectors;  ///< one in each column, of unit length
};

/// Eigenvalues and eigenvectors of a symmetric matrix, of which the lower half is read.
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix);

/// x with the least |A x - b|, and among several such x the shortest (complete orthogonal decomposition).
Eigen::MatrixXd solve_least_squares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b);

/// x with A x = b for a symmetric positive semi-definite A, as normal equations have (LDLT).
Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b);

/// M with M M^T = A for a symmetric positive semi-definite A; what rounding has made negative counts as 0.
Eigen::MatrixXd symmetric_root(const Eigen::MatrixXd& A);

/// The inverse of a square matrix (LU with full pivoting); nothing where the matrix is singular, or its
/// reciprocal condition number is not above `least_rcond`.
std::optional<Eigen::MatrixXd> inverse_of(const Eigen::MatrixXd& A, double least_rcond = 0);

/// Columns that span those of A, orthogonal and of unit length (QR); A has no more columns than rows.
Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& A);

/// The rotation nearest to a matrix in the sum of squares: M (M^T M)^(-1/2). Its determinant must be
/// positive.
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& matrix);

}  // namespace lightstripe
