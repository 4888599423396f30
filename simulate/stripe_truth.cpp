// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "simulate/stripe_truth.h"

#include <cmath>
#include <numbers>

#include "simulate/render.h"

namespace lightstripe {
namespace {

constexpr double kFanStep = 1e-4;  // radians; about 0.04 mm at the object
constexpr int kHalvings = 10;      // of a step, to follow steep surfaces and find where the line ends

struct Tracer {
  const World& world;
  const View& view;
  const Imaging& imaging;
  double spacing_px;
  std::vector<StripeTruth> points;

  std::optional<StripeTruth> at(double angle) const {
    const SimulatedSensor& sensor = *view.sensor;
    const Ray ray{view.source(),
                  view.moved.rotation * (std::cos(angle) * sensor.axis + std::sin(angle) * sensor.across)};
    const std::optional<SurfaceHit> hit = first_hit(world, ray);
    if (!hit) return std::nullopt;
    const Eigen::Vector3d p = ray.at(hit->s);
    const std::optional<Eigen::Vector2d> pixel = pixel_of(view, p);
    if (!pixel || blocked(world, view.eye(), p)) return std::nullopt;
    return StripeTruth{*pixel, p, laser_level(world, view, imaging, p, *hit)};
  }

  void keep(const std::optional<StripeTruth>& point) {
    if (!point) return;
    if (points.empty() || (points.back().pixel - point->pixel).norm() >= spacing_px) points.push_back(*point);
  }

  /// Adds what lies between two angles, both ends excluded.
  void refine(double from, const std::optional<StripeTruth>& a, double to,
              const std::optional<StripeTruth>& b, int depth) {
    if (depth == 0 || (!a && !b)) return;
    if (a && b && (a->pixel - b->pixel).norm() <= spacing_px) return;
    const double middle = 0.5 * (from + to);
    const std::optional<StripeTruth> between = at(middle);
    refine(from, a, middle, between, depth - 1);
    keep(between);
    refine(middle, between, to, b, depth - 1);
  }
};

}  // namespace

std::vector<StripeTruth> trace_stripe(const World& world, const View& view, const Imaging& imaging,
                                      double spacing_px) {
  Tracer tracer{world, view, imaging, spacing_px, {}};
  const double half_fan = view.sensor->laser.fan_deg / 2 * std::numbers::pi / 180;
  const int steps = static_cast<int>(std::ceil(2 * half_fan / kFanStep));
  std::optional<StripeTruth> before;
  double angle_before = -half_fan;
  for (int i = 0; i <= steps; ++i) {
    const double angle = half_fan * (2.0 * i / steps - 1);
    const std::optional<StripeTruth> point = tracer.at(angle);
    if (i > 0) tracer.refine(angle_before, before, angle, point, kHalvings);
    tracer.keep(point);
    before = point;
    angle_before = angle;
  }
  return tracer.points;
}

}  // namespace lightstripe
