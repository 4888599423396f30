// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "core/section_bends.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "calib/assess/uncertainty.h"
#include "core/linear_algebra.h"

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

std::vector<double> rounded(const VectorXd& coefficients) {
  constexpr double kStepsPerMm = 1e6;
  std::vector<double> out;
  for (const double c : coefficients) out.push_back(std::round(c * kStepsPerMm) / kStepsPerMm);
  return out;
}

/// The errors as the part of the section that these sensors see has them, less the rigid motions: products
/// of every two errors' displacements, over the sum of all squares. Empty where too little is seen.
MatrixXd seen_by(const std::vector<int>& sensors, RigidMotions motions, const SectionErrors& errors,
                 const MatrixXd& displacements) {
  std::vector<Index> rows;
  for (std::size_t i = 0; i < errors.samples.size(); ++i)
    if (std::find(sensors.begin(), sensors.end(), errors.samples[i].sensor) != sensors.end())
      for (const Index axis : {0, 1}) rows.push_back(2 * static_cast<Index>(i) + axis);
  if (rows.size() < 2 * kAllMotions) return {};
  const MatrixXd seen = without_rigid_motion(errors.section(rows), displacements(rows, Eigen::all), motions);
  return seen.transpose() * seen / std::max(seen.squaredNorm(), 1e-300);
}

/// The whole section as it is measured, and the parts whose own bending counts however far they may be
/// shifted against each other: every sensor's, every pair's.
std::vector<MatrixXd> looks_at(const SectionErrors& errors, const MatrixXd& displacements, int sensors,
                               SectionFreedom freedom) {
  std::vector<int> all(static_cast<std::size_t>(sensors));
  std::iota(all.begin(), all.end(), 0);
  std::vector<MatrixXd> grams;
  const auto look = [&](const std::vector<int>& by, RigidMotions motions) {
    MatrixXd gram = seen_by(by, motions, errors, displacements);
    if (gram.size() > 0) grams.push_back(std::move(gram));
  };
  look(all, kAllMotions);
  if (freedom == SectionFreedom::kAlongAxis) look(all, kShifts), look(all, kShiftAlong);
  for (int a = 0; a < sensors && sensors > 1; ++a) {
    look({a}, kAllMotions);
    for (int b = a + 1; b < sensors && sensors > 2; ++b) look({a, b}, kAllMotions);
  }
  return grams;
}

/// Whether every look sees at most `left` of its squared displacements in the columns of `dropped`.
bool all_see_little(const std::vector<MatrixXd>& looks, const MatrixXd& dropped, double left) {
  return std::all_of(looks.begin(), looks.end(), [&](const MatrixXd& gram) {
    return (gram * dropped).cwiseProduct(dropped).sum() <= left;
  });
}

}  // namespace

SectionBends section_bends(const SectionErrors& errors, const MatrixXd& covariance, SectionFreedom freedom) {
  constexpr double kLeft = 0.05;  // of the summed variance, of every look
  constexpr std::size_t kFewest = 10;
  SectionBends out;
  if (errors.samples.size() < kFewest) return out;
  const Eigen::Vector2d centre =
      Eigen::Map<const Eigen::Matrix2Xd>(errors.section.data(), 2, errors.section.size() / 2)
          .rowwise()
          .mean();
  out.centre_mm = {std::round(centre.x()), std::round(centre.y())};
  int sensors = 0;
  for (const SectionSample& sample : errors.samples) sensors = std::max(sensors, sample.sensor + 1);
  const MatrixXd displacements =
      without_rigid_motion(errors.section, errors.jacobian * symmetric_root(covariance),
                           freedom == SectionFreedom::kRigid ? kAllMotions : kShiftAlong);
  const MatrixXd basis = basis_of(out, errors.section, errors.samples, sensors);
  const MatrixXd coefficients = solve_least_squares(basis, displacements);
  const std::vector<MatrixXd> looks = looks_at(errors, basis * coefficients, sensors, freedom);
  if (looks.empty()) return out;
  // Any turn of independent errors of one sigma are such errors: the one in which the first of them are seen
  // most.
  MatrixXd sum = looks.front();
  for (std::size_t i = 1; i < looks.size(); ++i) sum += looks[i];
  const SymmetricEigen eigen = symmetric_eigen(sum);
  for (Index left = sum.cols(); left > 0; --left) {
    if (all_see_little(looks, eigen.vectors.leftCols(left), kLeft)) break;
    out.bends.push_back(rounded(coefficients * eigen.vectors.col(left - 1)));
  }
  return out;
}

SectionBends section_bends(const SessionViews& session, const JointAdjustment& adjustment,
                           const SectionErrors& errors, const Eigen::Vector3d& up) {
  if (session.motion != MotionType::kRotary)
    return section_bends(errors, adjustment.covariance, SectionFreedom::kRigid);
  return section_bends(axial_section_errors(adjustment, up, errors.samples), adjustment.covariance,
                       SectionFreedom::kAlongAxis);
}

}  // namespace lightstripe
