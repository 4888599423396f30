// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/adjust/reduced_covariance.h"

#include <ceres/crs_matrix.h>

#include <Eigen/SparseCore>
#include <limits>

#include "core/linear_algebra.h"

namespace lightstripe {
namespace {

constexpr double kMaxCondition =
    1e13;  // beyond it double precision cannot tell the matrix from a singular one

Eigen::SparseMatrix<double> normal_matrix(JointProblem& joint) {
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks = joint.blocks();
  ceres::CRSMatrix crs;
  joint.problem().Evaluate(options, nullptr, nullptr, nullptr, &crs);
  const Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>> J(
      crs.num_rows, crs.num_cols, static_cast<Eigen::Index>(crs.values.size()), crs.rows.data(),
      crs.cols.data(), crs.values.data());
  const Eigen::SparseMatrix<double> columns = J;
  return columns.transpose() * columns;
}

}  // namespace

ReducedCovariance reduced_covariance(JointProblem& joint) {
  const Eigen::SparseMatrix<double> H = normal_matrix(joint);
  const Eigen::Index n = joint.num_globals();
  Eigen::MatrixXd S = Eigen::MatrixXd(H.topLeftCorner(n, n));
  for (Eigen::Index pose = n; pose < H.cols(); pose += 6) {
    const Eigen::MatrixXd coupling = Eigen::MatrixXd(H.block(0, pose, n, 6));
    const Eigen::MatrixXd own = Eigen::MatrixXd(H.block(pose, pose, 6, 6));
    S -= coupling * solve_symmetric(own, coupling.transpose());
  }
  ReducedCovariance result;
  result.condition = std::numeric_limits<double>::infinity();
  if (!(S.diagonal().minCoeff() > 0)) return result;
  const Eigen::VectorXd scale = S.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * S * scale.asDiagonal();
  const SymmetricEigen eigen = symmetric_eigen(scaled);
  const auto& lambda = eigen.values;
  if (!(lambda[0] > 0)) return result;
  result.condition = lambda[n - 1] / lambda[0];
  if (result.condition > kMaxCondition) return result;
  const Eigen::MatrixXd inverse =
      eigen.vectors * lambda.cwiseInverse().asDiagonal() * eigen.vectors.transpose();
  result.covariance = scale.asDiagonal() * inverse * scale.asDiagonal();
  return result;
}

}  // namespace lightstripe
