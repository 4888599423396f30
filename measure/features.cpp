// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/features.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/transform.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

/// A feature as geometry, out of its parameters.
struct Shape {
  ShapeFit::Kind kind = ShapeFit::Kind::kPoint;
  Vector2d place = Vector2d::Zero();   ///< point; middle of a line; centre of an arc
  Vector2d along = Vector2d::UnitX();  ///< line
  double radius = 0;

  Vector2d normal() const { return {-along.y(), along.x()}; }
};

Shape shape_of(const ShapeFit& fit, const Eigen::VectorXd& parameters) {
  Shape out;
  out.kind = fit.kind;
  if (fit.kind == ShapeFit::Kind::kLine) {
    out.along = Eigen::Rotation2Dd(parameters(1)) * fit.along;
    out.place = fit.place + parameters(0) * Vector2d(-fit.along.y(), fit.along.x());
  } else {
    out.place = parameters.head<2>();
    if (fit.kind == ShapeFit::Kind::kArc) out.radius = parameters(2);
  }
  return out;
}

/// What fits a value depends on, and how.
using Shapes = std::vector<Shape>;
using Function = std::function<double(const Shapes&)>;

Shapes shapes_of(const std::vector<const ShapeFit*>& fits) {
  Shapes out;
  for (const ShapeFit* fit : fits) out.push_back(shape_of(*fit, fit->parameters));
  return out;
}

/// The function's derivative by one fit's parameters, central differences.
Eigen::VectorXd gradient(const Function& value, const std::vector<const ShapeFit*>& fits, std::size_t which) {
  constexpr double kStep = 1e-5;
  Shapes shapes = shapes_of(fits);
  const ShapeFit& fit = *fits[which];
  Eigen::VectorXd out(fit.parameters.size());
  for (Eigen::Index k = 0; k < out.size(); ++k) {
    Eigen::VectorXd varied = fit.parameters;
    varied(k) += kStep;
    shapes[which] = shape_of(fit, varied);
    const double high = value(shapes);
    varied(k) -= 2 * kStep;
    shapes[which] = shape_of(fit, varied);
    out(k) = (high - value(shapes)) / (2 * kStep);
  }
  return out;
}

Estimate evaluate(const Function& value, const std::vector<const ShapeFit*>& fits) {
  const double result = value(shapes_of(fits));
  if (!std::isfinite(result)) return Estimate::unknown("its features do not meet");
  double variance = 0;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    if (std::find(fits.begin(), fits.begin() + static_cast<std::ptrdiff_t>(i), fits[i]) !=
        fits.begin() + static_cast<std::ptrdiff_t>(i))
      continue;  // counted with its first place
    Eigen::VectorXd sum = gradient(value, fits, i);
    for (std::size_t k = i + 1; k < fits.size(); ++k)
      if (fits[k] == fits[i]) sum += gradient(value, fits, k);
    variance += sum.dot(fits[i]->covariance * sum);
  }
  return Estimate::known(result, std::sqrt(std::max(0.0, variance)));
}

Vector2d crossing(const Shape& a, const Shape& b) {
  const double across = a.along.x() * b.along.y() - a.along.y() * b.along.x();
  const Vector2d arm = b.place - a.place;
  return a.place + a.along * ((arm.x() * b.along.y() - arm.y() * b.along.x()) / across);
}

/// Two lines' crossing as a point with its covariance.
ShapeFit crossing_fit(const ShapeFit& a, const ShapeFit& b) {
  constexpr double kFlattest = 0.005;  // rad
  ShapeFit out;
  if (!a.known() || !b.known()) {
    out.reason = a.known() ? b.reason : a.reason;
    return out;
  }
  if (std::abs(a.along.x() * b.along.y() - a.along.y() * b.along.x()) < kFlattest) {
    out.reason = "its lines are parallel";
    return out;
  }
  out.kind = ShapeFit::Kind::kPoint;
  out.parameters = crossing(shape_of(a, a.parameters), shape_of(b, b.parameters));
  out.covariance = Eigen::Matrix2d::Zero();
  const std::vector<const ShapeFit*> fits{&a, &b};
  for (std::size_t i = 0; i < 2; ++i) {
    Eigen::Matrix2d J;
    for (int axis = 0; axis < 2; ++axis)
      J.row(axis) =
          gradient([&](const Shapes& s) { return crossing(s[0], s[1])(axis); }, fits, i).transpose();
    out.covariance += J * fits[i]->covariance * J.transpose();
  }
  out.num_points = a.num_points + b.num_points;
  out.rms_mm = std::max(a.rms_mm, b.rms_mm);
  out.reason.clear();
  return out;
}

bool inside(const std::vector<double>& range, double value) {
  return range.size() != 2 || (value >= range[0] && value <= range[1]);
}

struct Fitter {
  const Section& section;
  const FeatureFile& file;
  std::vector<ShapeFit> fits;

  std::size_t index_of(const std::string& name) const {
    for (std::size_t i = 0; i < file.features.size(); ++i)
      if (file.features[i].name == name) return i;
    return file.features.size();
  }

  ShapeFit fit(const FeatureRecipe& recipe) const {
    if (recipe.type == FeatureType::kIntersection)
      return crossing_fit(fits[index_of(recipe.of[0])], fits[index_of(recipe.of[1])]);
    Vector2d origin = Vector2d::Zero();
    if (!recipe.anchor.empty()) {
      const ShapeFit& anchor = fits[index_of(recipe.anchor)];
      if (!anchor.known()) {
        ShapeFit out;
        out.reason = "its anchor " + recipe.anchor + " is missing: " + anchor.reason;
        return out;
      }
      origin = shape_of(anchor, anchor.parameters).place;
    }
    FeaturePoints points;
    for (const SectionPoint& p : section)
      if (inside(recipe.u, p.position.x() - origin.x()) && inside(recipe.v, p.position.y() - origin.y()))
        points.push_back(p);
    switch (recipe.type) {
      case FeatureType::kArc:
        return fit_arc(points);
      case FeatureType::kMax:
        return fit_extreme(points, 1, recipe.half_width_mm);
      case FeatureType::kMin:
        return fit_extreme(points, -1, recipe.half_width_mm);
      case FeatureType::kLeftEnd:
        return fit_end(points, -1);
      case FeatureType::kRightEnd:
        return fit_end(points, 1);
      case FeatureType::kKnee: {
        const KneeFit knee = fit_knee(points);
        return crossing_fit(knee.left, knee.right);
      }
      default:
        return fit_line(points);
    }
  }
};

/// Distance of the second feature's place from the first: across a line, else between the places.
double signed_distance(const Shape& a, const Shape& b) {
  if (a.kind == ShapeFit::Kind::kLine) return (b.place - a.place).dot(a.normal());
  return (b.place - a.place).norm();
}

double distance(const Shape& a, const Shape& b) {
  if (a.kind == ShapeFit::Kind::kLine) return std::abs(signed_distance(a, b));
  return b.kind == ShapeFit::Kind::kLine ? std::abs(signed_distance(b, a)) : signed_distance(a, b);
}

/// Of two directions without sense, 0 to 90 degrees.
double angle_between(const Shape& a, const Shape& b) {
  const double cross = a.along.x() * b.along.y() - a.along.y() * b.along.x();
  return std::atan2(std::abs(cross), std::abs(a.along.dot(b.along))) / kDegree;
}

Function function_of(QuantityType type, std::size_t features) {
  switch (type) {
    case QuantityType::kAngle:
      if (features == 1)
        return [](const Shapes& s) { return std::atan2(s[0].along.y(), s[0].along.x()) / kDegree; };
      return [](const Shapes& s) { return angle_between(s[0], s[1]); };
    case QuantityType::kRadius:
      return [](const Shapes& s) { return s[0].radius; };
    case QuantityType::kStepHeight:
      return [](const Shapes& s) { return signed_distance(s[0], s[1]); };
    case QuantityType::kDistance:
      return [](const Shapes& s) { return distance(s[0], s[1]); };
    case QuantityType::kWidth:
      return [](const Shapes& s) { return std::abs(s[1].place.x() - s[0].place.x()); };
    // Along the reference line where a third feature gives one.
    case QuantityType::kGap:
      if (features == 3) return [](const Shapes& s) { return (s[1].place - s[0].place).dot(s[2].along); };
      return [](const Shapes& s) { return s[1].place.x() - s[0].place.x(); };
    case QuantityType::kFlush:
      if (features == 3) return [](const Shapes& s) { return (s[1].place - s[0].place).dot(s[2].normal()); };
      return [](const Shapes& s) { return s[1].place.y() - s[0].place.y(); };
    case QuantityType::kPositionU:
      return [](const Shapes& s) { return s[0].place.x(); };
    default:
      return [](const Shapes& s) { return s[0].place.y(); };
  }
}

/// Between the section and a line, + above it, by trapezoids over [from, to] along the line.
Estimate area_over(const Section& section, const ShapeFit& line, const std::vector<double>& range) {
  const Shape shape = shape_of(line, line.parameters);
  std::vector<std::pair<double, double>> points;
  for (const SectionPoint& p : section) {
    const Vector2d arm = p.position - shape.place;
    if (inside(range, arm.dot(shape.along)))
      points.emplace_back(arm.dot(shape.along), arm.dot(shape.normal()));
  }
  std::sort(points.begin(), points.end());
  if (points.size() < 5) return Estimate::unknown("no points over its line");
  const double length = points.back().first - points.front().first;
  double area = 0, widest = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double step = points[i].first - points[i - 1].first;
    area += step * (points[i].second + points[i - 1].second) / 2, widest = std::max(widest, step);
  }
  if (widest > std::max(1.0, length / 10)) return Estimate::unknown("hole in the section over its line");
  const double middle = (points.back().first + points.front().first) / 2;
  const double spacing = length / static_cast<double>(points.size() - 1);
  const double noise = line.rms_mm * line.rms_mm * line.correlated_points * spacing * length;
  const double base = length * length * (line.covariance(0, 0) + middle * middle * line.covariance(1, 1));
  return Estimate::known(area, std::sqrt(noise + base));
}

/// Peak to valley about the feature's own line. Its sigma: the two extremes err by a point's scatter each.
Estimate flatness_of(const ShapeFit& fit) {
  return Estimate::known(fit.peak_to_valley_mm, fit.rms_mm * std::numbers::sqrt2);
}

struct Measurer {
  const Section& section;
  const Fitter& fitter;

  Estimate measure(const QuantityRecipe& recipe) const {
    std::vector<const ShapeFit*> fits;
    for (const std::string& name : recipe.of) {
      const ShapeFit& fit = fitter.fits[fitter.index_of(name)];
      if (!fit.known()) return Estimate::unknown(name + ": " + fit.reason);
      fits.push_back(&fit);
    }
    if (recipe.type == QuantityType::kFlatness) return flatness_of(*fits[0]);
    if (recipe.type == QuantityType::kArea) return area_over(section, *fits[0], recipe.u);
    return evaluate(function_of(recipe.type, fits.size()), fits);
  }
};

std::string verdict_of(const FeatureFile& file, const std::vector<Estimate>& quantities) {
  bool limited = false, missing = false;
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const QuantityRecipe& recipe = file.measurements[i];
    if (!recipe.min && !recipe.max) continue;
    limited = true;
    const std::optional<double>& value = quantities[i].value;
    if (!value)
      missing = true;
    else if ((recipe.min && *value < *recipe.min) || (recipe.max && *value > *recipe.max))
      return "fail";
  }
  return !limited ? "" : missing ? "unknown" : "pass";
}

}  // namespace

MeasuredFeatures measure_features(const Profile& profile, const FeatureFile& file) {
  const Section section = section_of(profile);
  Fitter fitter{section, file, {}};
  for (const FeatureRecipe& recipe : file.features) fitter.fits.push_back(fitter.fit(recipe));
  MeasuredFeatures out;
  out.frame = profile.frame, out.travel = profile.travel;
  for (const QuantityRecipe& recipe : file.measurements)
    out.quantities.push_back(Measurer{section, fitter}.measure(recipe));
  out.verdict = verdict_of(file, out.quantities);
  out.features = std::move(fitter.fits);
  return out;
}

}  // namespace lightstripe
