// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/feature_fit.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/linear_algebra.h"
#include "core/robust.h"
#include "measure/robust_line.h"

namespace lightstripe {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kFloorMm = 1e-6;  // of the robust scale
constexpr int kRounds = 6;

ShapeFit unknown(const char* reason) {
  ShapeFit out;
  out.reason = reason;
  return out;
}

std::vector<double> tukey_weights(const std::vector<double>& residuals) {
  std::vector<double> sizes;
  for (const double r : residuals) sizes.push_back(std::abs(r));
  const double scale = std::max(kFloorMm, kMadToSigma * median(sizes));
  std::vector<double> weights;
  for (const double r : residuals) weights.push_back(tukey_weight(r / scale));
  return weights;
}

/// Median of the points' own predicted errors; 0 where they have none.
double predicted_sigma(const FeaturePoints& points) {
  std::vector<double> sigmas;
  for (const SectionPoint& p : points) sigmas.push_back(p.sigma_mm);
  return sigmas.empty() ? 0.0 : median(std::move(sigmas));
}

/// Scatter, correlation and spread of the residuals that count, and the variance of one independent point.
double add_fit(const FeaturePoints& points, const std::vector<double>& residuals,
               const std::vector<double>& weights, int parameters, ShapeFit& out) {
  double squares = 0, sum = 0, low = 1e300, high = -1e300;
  std::vector<double> counting;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    if (!(weights[i] > 0)) continue;
    squares += weights[i] * residuals[i] * residuals[i], sum += weights[i];
    low = std::min(low, residuals[i]), high = std::max(high, residuals[i]);
    counting.push_back(residuals[i]);
  }
  out.num_points = static_cast<int>(counting.size());
  if (out.num_points <= parameters || !(sum > 0)) return -1;
  out.rms_mm = std::sqrt(squares / sum);
  out.peak_to_valley_mm = high - low;
  out.correlated_points = shared_by(counting);
  const double n = out.num_points;
  // What the shape has taken up of the scatter comes back.
  const double scatter = kTukeyVariance * squares / sum * n / (n - parameters);
  const double own = predicted_sigma(points);
  return std::max(scatter, own * own) * out.correlated_points;
}

struct Line {
  Vector2d middle, along;
};

Line weighted_line(const FeaturePoints& points, const std::vector<double>& weights) {
  double sum = 0;
  Vector2d middle = Vector2d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i)
    sum += weights[i], middle += weights[i] * points[i].position;
  middle /= sum;
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector2d arm = points[i].position - middle;
    spread += weights[i] * arm * arm.transpose();
  }
  Vector2d along = symmetric_eigen(spread).vectors.col(1);
  if (along.x() < 0 || (along.x() == 0 && along.y() < 0)) along = -along;
  return {middle, along};
}

std::vector<double> distances(const FeaturePoints& points, const Line& line) {
  std::vector<double> out;
  const Vector2d normal(-line.along.y(), line.along.x());
  for (const SectionPoint& p : points) out.push_back((p.position - line.middle).dot(normal));
  return out;
}

/// Kasa's circle: u^2 + v^2 is linear in what is sought.
bool kasa(const FeaturePoints& points, const Vector2d& middle, Vector3d& circle) {
  Matrix3d H = Matrix3d::Zero();
  Vector3d g = Vector3d::Zero();
  for (const SectionPoint& p : points) {
    const Vector2d q = p.position - middle;
    const Vector3d row(q.x(), q.y(), 1);
    H += row * row.transpose();
    g += row * q.squaredNorm();
  }
  const auto inverse = inverse_of(H, 1e-12);
  if (!inverse) return false;
  const Vector3d c = *inverse * g;
  circle = {c.x() / 2, c.y() / 2, std::sqrt(std::max(0.0, c.z() + (c.x() * c.x() + c.y() * c.y()) / 4))};
  return circle.z() > 0;
}

std::vector<double> circle_residuals(const FeaturePoints& points, const Vector2d& middle,
                                     const Vector3d& circle) {
  std::vector<double> out;
  for (const SectionPoint& p : points)
    out.push_back((p.position - middle - circle.head<2>()).norm() - circle.z());
  return out;
}

Matrix3d circle_normal_matrix(const FeaturePoints& points, const Vector2d& middle, const Vector3d& circle,
                              const std::vector<double>& weights, const std::vector<double>& residuals,
                              Vector3d& gradient) {
  Matrix3d H = Matrix3d::Zero();
  gradient.setZero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector2d out = (points[i].position - middle - circle.head<2>()).normalized();
    const Vector3d row(-out.x(), -out.y(), -1);
    H += weights[i] * row * row.transpose();
    gradient += weights[i] * residuals[i] * row;
  }
  return H;
}

}  // namespace

double shared_by(const std::vector<double>& residuals) {
  constexpr std::size_t kMostLags = 60;
  const std::size_t n = residuals.size();
  double squares = 0;
  for (const double r : residuals) squares += r * r;
  if (n < 20 || !(squares > 0)) return 1;
  const double variance = squares / static_cast<double>(n), chance = 2 / std::sqrt(static_cast<double>(n));
  double sum = 1;
  for (std::size_t lag = 1; lag <= std::min(kMostLags, n / 4); ++lag) {
    double product = 0;
    for (std::size_t i = lag; i < n; ++i) product += residuals[i] * residuals[i - lag];
    const double correlation = product / static_cast<double>(n - lag) / variance;
    if (correlation < chance) break;
    sum += 2 * correlation;
  }
  return sum;
}

ShapeFit fit_line(const FeaturePoints& points) {
  constexpr std::size_t kFewest = 5;
  if (points.size() < kFewest) return unknown(points.empty() ? "no points in its range" : "too few points");
  std::vector<double> weights(points.size(), 1.0);
  Line line = weighted_line(points, weights);
  for (int round = 0; round < kRounds; ++round) {
    weights = tukey_weights(distances(points, line));
    line = weighted_line(points, weights);
  }
  ShapeFit out;
  const double variance = add_fit(points, distances(points, line), weights, 2, out);
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double s = (points[i].position - line.middle).dot(line.along);
    sum += weights[i], squares += weights[i] * s * s;
    if (weights[i] > 0) out.half_length_mm = std::max(out.half_length_mm, std::abs(s));
  }
  if (variance < 0 || !(squares > 0)) return unknown("its points are no line");
  out.parameters = Eigen::Vector2d::Zero();
  out.covariance = Eigen::Vector2d(variance / sum, variance / squares).asDiagonal();
  out.place = line.middle, out.along = line.along;
  out.reason.clear();
  return out;
}

ShapeFit fit_arc(const FeaturePoints& points) {
  constexpr std::size_t kFewest = 8;
  constexpr double kLargestMm = 1e5;
  if (points.size() < kFewest) return unknown(points.empty() ? "no points in its range" : "too few points");
  Vector2d middle = Vector2d::Zero();
  for (const SectionPoint& p : points) middle += p.position / static_cast<double>(points.size());
  Vector3d circle;
  if (!kasa(points, middle, circle)) return unknown("its points are no arc");
  std::vector<double> weights(points.size(), 1.0);
  Vector3d gradient;
  for (int round = 0; round < 3 * kRounds; ++round) {
    const std::vector<double> residuals = circle_residuals(points, middle, circle);
    if (round >= 2) weights = tukey_weights(residuals);
    const Matrix3d H = circle_normal_matrix(points, middle, circle, weights, residuals, gradient);
    const Vector3d step = solve_least_squares(H, gradient);
    if (!step.allFinite()) return unknown("its points are no arc");
    circle -= step;
    if (round > kRounds && step.norm() < 1e-10) break;
  }
  if (!(circle.z() > 0) || circle.z() > kLargestMm) return unknown("its points are no arc");
  const std::vector<double> residuals = circle_residuals(points, middle, circle);
  ShapeFit out;
  out.kind = ShapeFit::Kind::kArc;
  const double variance = add_fit(points, residuals, weights, 3, out);
  const auto inverse = inverse_of(circle_normal_matrix(points, middle, circle, weights, residuals, gradient));
  if (variance < 0 || !inverse) return unknown("its points are no arc");
  out.parameters = Vector3d(circle.x() + middle.x(), circle.y() + middle.y(), circle.z());
  out.covariance = variance * *inverse;
  out.reason.clear();
  return out;
}

ShapeFit fit_extreme(const FeaturePoints& points, int sign, double half_width_mm) {
  if (points.size() < 5) return unknown(points.empty() ? "no points in its range" : "too few points");
  const auto best =
      std::max_element(points.begin(), points.end(), [&](const SectionPoint& a, const SectionPoint& b) {
        return sign * a.position.y() < sign * b.position.y();
      });
  const Vector2d at = best->position;
  FeaturePoints near;
  std::vector<Sample1> samples;
  for (const SectionPoint& p : points)
    if (std::abs(p.position.x() - at.x()) <= half_width_mm) {
      near.push_back(p);
      samples.push_back({p.position.x() - at.x(), p.position.y() - at.y()});
    }
  const auto fit = fit_polynomial(samples, 2, kFloorMm);
  if (!fit) return unknown("too few points about its extreme");
  if (sign * fit->curvature >= 0) return unknown("no extreme within its range");
  const double vertex = -fit->slope / fit->curvature;
  if (std::abs(vertex) > half_width_mm) return unknown("its extreme lies at the end of its range");
  std::vector<double> residuals, weights(near.size(), 1.0);
  for (const Sample1& s : samples)
    residuals.push_back(s.value - fit->value - fit->slope * s.t - fit->curvature / 2 * s.t * s.t);
  weights = tukey_weights(residuals);
  ShapeFit out;
  out.kind = ShapeFit::Kind::kPoint;
  const double variance = add_fit(near, residuals, weights, 3, out);
  Matrix3d H = Matrix3d::Zero();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Vector3d row(1, samples[i].t, samples[i].t * samples[i].t / 2);
    H += weights[i] * row * row.transpose();
  }
  if (variance < 0) return unknown("too few points about its extreme");
  // u = -slope / curvature; v = value + slope u + curvature u^2 / 2, whose change with u vanishes.
  Eigen::Matrix<double, 2, 3> J;
  J << 0, -1 / fit->curvature, -vertex / fit->curvature, 1, vertex, vertex * vertex / 2;
  out.parameters = at + Vector2d(vertex, fit->value + fit->slope * vertex / 2);
  out.covariance = variance * J * H.inverse() * J.transpose();
  out.reason.clear();
  return out;
}

KneeFit fit_knee(const FeaturePoints& all) {
  constexpr std::size_t kFewest = 6;
  FeaturePoints points = all;
  std::stable_sort(points.begin(), points.end(), [](const SectionPoint& a, const SectionPoint& b) {
    return a.position.x() < b.position.x();
  });
  KneeFit out{unknown("too few points"), unknown("too few points")};
  if (points.size() < 2 * kFewest) return out;
  // Sums up to each point, so that a split's residuals cost nothing.
  struct Sums {
    double n = 0, u = 0, v = 0, uu = 0, uv = 0, vv = 0;
    double smallest_spread() const {
      const double a = uu - u * u / n, b = uv - u * v / n, c = vv - v * v / n;
      return (a + c) / 2 - std::hypot((a - c) / 2, b);
    }
  };
  std::vector<Sums> sums(points.size() + 1);
  const Vector2d origin = points[points.size() / 2].position;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector2d p = points[i].position - origin;
    const Sums& s = sums[i];
    sums[i + 1] = {
        s.n + 1, s.u + p.x(), s.v + p.y(), s.uu + p.x() * p.x(), s.uv + p.x() * p.y(), s.vv + p.y() * p.y()};
  }
  std::size_t split = kFewest;
  double least = 1e300;
  for (std::size_t k = kFewest; k + kFewest <= points.size(); ++k) {
    const Sums &a = sums[k], &all_sums = sums.back();
    const Sums b{all_sums.n - a.n,   all_sums.u - a.u,   all_sums.v - a.v,
                 all_sums.uu - a.uu, all_sums.uv - a.uv, all_sums.vv - a.vv};
    if (const double bad = a.smallest_spread() + b.smallest_spread(); bad < least) least = bad, split = k;
  }
  const auto middle = points.begin() + static_cast<std::ptrdiff_t>(split);
  // The points next to the split may belong to either side.
  out.left = fit_line({points.begin(), middle - 1});
  out.right = fit_line({middle + 1, points.end()});
  return out;
}

ShapeFit fit_end(const FeaturePoints& points, int sign) {
  if (points.size() < 3) return unknown("no points in its range");
  std::vector<Vector2d> places;
  for (const SectionPoint& p : points) places.push_back(p.position);
  std::sort(places.begin(), places.end(),
            [&](const Vector2d& a, const Vector2d& b) { return sign * a.x() > sign * b.x(); });
  const double spacing = (places[0] - places[2]).norm() / 2;
  ShapeFit out;
  out.kind = ShapeFit::Kind::kPoint;
  out.parameters = places[0];
  const double own = predicted_sigma(points), step = spacing / std::sqrt(12.0);
  out.covariance = Vector2d(own * own + step * step, own * own).asDiagonal();
  out.num_points = 1;
  out.reason.clear();
  return out;
}

}  // namespace lightstripe
