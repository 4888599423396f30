// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Lines, arcs and extremes fitted to parts of a section, with the covariance of their parameters.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "measure/section.h"

namespace lightstripe {

/// A fitted shape: a few parameters that can be varied, and how well they are known.
struct ShapeFit {
  enum class Kind { kLine, kArc, kPoint };
  Kind kind = Kind::kLine;
  std::string reason = "not fitted";  ///< empty: known
  /// Line: (offset along the normal, mm; turn, rad) from the line through `place` along `along`. Arc: centre
  /// u, v and radius. Point: u, v.
  Eigen::VectorXd parameters;
  Eigen::MatrixXd covariance;
  Eigen::Vector2d place = Eigen::Vector2d::Zero();   ///< line: weighted middle of its points
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();  ///< line: unit, u grows
  double half_length_mm = 0;                         ///< line: how far its points reach from `place`
  double rms_mm = 0;                                 ///< scatter about the shape
  double correlated_points = 1;                      ///< neighbours that share one error
  double peak_to_valley_mm = 0;                      ///< of the points that count
  int num_points = 0;

  bool known() const { return reason.empty(); }
};

/// Points that a feature looks at, in their order along the section.
using FeaturePoints = std::vector<SectionPoint>;

/// Total least squares with Tukey's weights; at least 5 points over some length.
ShapeFit fit_line(const FeaturePoints& points);
/// Geometric circle fit (Gauss-Newton from Kasa's) with Tukey's weights; at least 8 points.
ShapeFit fit_arc(const FeaturePoints& points);
/// The top of a parabola v(u) through the points within `half_width_mm` of the highest one (`sign` +1) or the
/// lowest one (-1).
ShapeFit fit_extreme(const FeaturePoints& points, int sign, double half_width_mm);
/// The two lines that meet where the points bend, each as fit_line(); split where their residuals are least.
struct KneeFit {
  ShapeFit left, right;
};
KneeFit fit_knee(const FeaturePoints& points);
/// The first (`sign` -1) or the last point along u: the edge of a gap. Its sigma is that of a step of the
/// spacing.
ShapeFit fit_end(const FeaturePoints& points, int sign);

/// How many neighbours share one error, of residuals in order: 1 + 2 sum of the autocorrelation as far as it
/// stands out of what independent noise shows by chance (2 / sqrt n).
double shared_by(const std::vector<double>& residuals);

}  // namespace lightstripe
