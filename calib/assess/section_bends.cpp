// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "core/section_bends.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <cmath>

#include "calib/assess/uncertainty.h"

namespace lightstripe {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kTerms = static_cast<Index>(SectionBends::kTerms);

/// What turns the sensors' coefficients into displacements (y, z) of the samples: 2n x 2 kTerms sensors.
MatrixXd basis_of(const SectionBends& bends, const VectorXd& section,
                  const std::vector<SectionSample>& samples, Index sensors) {
  MatrixXd basis = MatrixXd::Zero(section.size(), 2 * kTerms * sensors);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto row = 2 * static_cast<Index>(i), column = 2 * kTerms * samples[i].sensor;
    const auto terms = bend_terms(bends, section(row), section(row + 1));
    for (Index t = 0; t < kTerms; ++t)
      basis(row, column + t) = basis(row + 1, column + kTerms + t) = terms[static_cast<std::size_t>(t)];
  }
  return basis;
}

/// M with M M^T = the covariance; what rounding has made negative counts as 0.
MatrixXd root_of(const MatrixXd& covariance) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(covariance);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
}

std::vector<double> rounded(const VectorXd& coefficients) {
  constexpr double kStepsPerMm = 1e6;
  std::vector<double> out;
  for (const double c : coefficients) out.push_back(std::round(c * kStepsPerMm) / kStepsPerMm);
  return out;
}

}  // namespace

SectionBends section_bends(const SessionViews& session, const JointAdjustment& adjustment,
                           const Eigen::Vector3d& up) {
  constexpr double kKept = 0.95;  // of the summed variance
  constexpr std::size_t kFewest = 10;
  SectionBends out;
  const auto samples = section_samples(session, adjustment.residuals);
  if (samples.size() < kFewest) return out;
  const VectorXd section = section_of(adjustment.state, session.motion, up, samples);
  const Eigen::Vector2d centre =
      Eigen::Map<const Eigen::Matrix2Xd>(section.data(), 2, section.size() / 2).rowwise().mean();
  out.centre_mm = {std::round(centre.x()), std::round(centre.y())};
  const MatrixXd errors = without_rigid_motion(section) * section_jacobian(session, adjustment, up, samples) *
                          root_of(adjustment.covariance);
  const MatrixXd basis = basis_of(out, section, samples, static_cast<Index>(adjustment.state.sensors.size()));
  const MatrixXd coefficients = basis.completeOrthogonalDecomposition().solve(errors);
  const MatrixXd displaced = basis * coefficients;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(displaced.transpose() * displaced);
  double left = eigen.eigenvalues().sum();
  const double least = (1 - kKept) * left;
  for (Index i = eigen.eigenvalues().size(); i-- > 0 && left > least;) {
    out.bends.push_back(rounded(coefficients * eigen.eigenvectors().col(i)));
    left -= eigen.eigenvalues()(i);
  }
  return out;
}

}  // namespace lightstripe
