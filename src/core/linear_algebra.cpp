// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "core/linear_algebra.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

namespace lightstripe {

using Eigen::MatrixXd;

SymmetricEigen symmetric_eigen(const MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

MatrixXd solve_least_squares(const MatrixXd& A, const MatrixXd& b) {
  return A.completeOrthogonalDecomposition().solve(b);
}

MatrixXd solve_symmetric(const MatrixXd& A, const MatrixXd& b) { return A.ldlt().solve(b); }

MatrixXd symmetric_root(const MatrixXd& A) {
  const SymmetricEigen eigen = symmetric_eigen(A);
  return eigen.vectors * eigen.values.cwiseMax(0).cwiseSqrt().asDiagonal();
}

std::optional<MatrixXd> inverse_of(const MatrixXd& A, double least_rcond) {
  const Eigen::FullPivLU<MatrixXd> lu(A);
  if (!lu.isInvertible() || !(lu.rcond() > least_rcond)) return std::nullopt;
  return lu.inverse();
}

MatrixXd orthonormal_basis(const MatrixXd& A) {
  return A.householderQr().householderQ() * MatrixXd::Identity(A.rows(), A.cols());
}

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& matrix) {
  const SymmetricEigen eigen = symmetric_eigen(matrix.transpose() * matrix);
  return matrix * eigen.vectors * eigen.values.cwiseSqrt().cwiseInverse().asDiagonal() *
         eigen.vectors.transpose();
}

}  // namespace lightstripe
