// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What is measured over the whole scan.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/linear_algebra.h"
#include "measure/features.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

/// Values over their places and the sigma of one.
struct Samples {
  std::vector<Eigen::VectorXd> places;  ///< rows of the linear model
  std::vector<double> values, sigmas;

  void add(const Eigen::VectorXd& place, double value, double sigma) {
    places.push_back(place), values.push_back(value), sigmas.push_back(sigma);
  }
};

/// Highest less lowest residual of the best linear model. Its sigma: the two extremes err by one value each.
Estimate spread_about_model(const Samples& samples) {
  const auto n = static_cast<Eigen::Index>(samples.values.size());
  Eigen::MatrixXd A(n, samples.places[0].size());
  Eigen::VectorXd b(n);
  double variance = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    A.row(i) = samples.places[k].transpose();
    b(i) = samples.values[k];
    variance += samples.sigmas[k] * samples.sigmas[k] / static_cast<double>(n);
  }
  const Eigen::VectorXd residuals = b - A * solve_least_squares(A, b);
  return Estimate::known(residuals.maxCoeff() - residuals.minCoeff(), std::sqrt(2 * variance));
}

Vector2d place_of(const ShapeFit& fit) {
  return fit.kind == ShapeFit::Kind::kLine ? fit.place : Vector2d(fit.parameters.head<2>());
}

double sigma_across(const ShapeFit& fit) {
  return std::sqrt(fit.kind == ShapeFit::Kind::kLine ? fit.covariance(0, 0) : fit.covariance(1, 1));
}

/// Both ends and the middle of a line, over (1, travel, u).
void add_line(const MeasuredFeatures& section, const ShapeFit& line, Samples& samples) {
  for (const double share : {-1.0, 0.0, 1.0}) {
    const double s = share * line.half_length_mm;
    const Vector2d p = line.place + s * line.along;
    const double sigma = std::sqrt(line.covariance(0, 0) + s * s * line.covariance(1, 1));
    samples.add(Eigen::Vector3d(1, section.travel, p.x()), p.y(), sigma);
  }
}

}  // namespace

std::vector<Estimate> measure_along(const std::vector<MeasuredFeatures>& sections, const FeatureFile& file) {
  const auto index_of = [&](const std::string& name) {
    std::size_t i = 0;
    while (i < file.features.size() && file.features[i].name != name) ++i;
    return i;
  };
  constexpr int kFewestSections = 3;
  std::vector<Estimate> out;
  for (const AlongRecipe& recipe : file.along) {
    Samples samples;
    int seen = 0;
    for (const MeasuredFeatures& section : sections) {
      const ShapeFit& first = section.features[index_of(recipe.of[0])];
      if (!first.known()) continue;
      ++seen;
      const Eigen::Vector2d straight(1, section.travel);
      if (recipe.type == AlongType::kFlatness) {
        add_line(section, first, samples);
      } else if (recipe.type == AlongType::kStraightness) {
        samples.add(straight, place_of(first).y(), sigma_across(first));
      } else {
        const ShapeFit& second = section.features[index_of(recipe.of[1])];
        if (!second.known()) {
          --seen;
          continue;
        }
        const Vector2d normal(-first.along.y(), first.along.x());
        samples.add(Eigen::VectorXd::Ones(1), (place_of(second) - place_of(first)).dot(normal),
                    std::hypot(sigma_across(first), sigma_across(second)));
      }
    }
    out.push_back(seen < kFewestSections ? Estimate::unknown("known in fewer than three sections")
                                         : spread_about_model(samples));
  }
  return out;
}

}  // namespace lightstripe
