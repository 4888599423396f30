// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/laser_reach.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Interval = std::array<double, 2>;

constexpr double kMostPoints = 0.9;   // of a stripe that have to lie in a plane's reach
constexpr std::size_t kSamples = 25;  // points looked at in a stripe
// An object that sticks out of the range by up to this part of its width is no surprise: inside and near
// explanations of a line count alike, and where they differ the line is dropped.
constexpr double kNearShare = 0.3;

double depth_at(const Camera& camera, const Plane& plane, const Vector2d& pixel) {
  const auto ray = unproject(camera, pixel);
  const auto p = ray ? intersect(plane, Vector3d::Zero(), *ray) : std::nullopt;
  return p ? p->z() : std::numeric_limits<double>::quiet_NaN();
}

std::vector<Vector2d> samples_of(const Stripe& stripe) {
  std::vector<Vector2d> pixels;
  const std::size_t step = std::max<std::size_t>(1, stripe.points.size() / kSamples);
  for (std::size_t i = 0; i < stripe.points.size(); i += step)
    pixels.emplace_back(stripe.points[i].x, stripe.points[i].y);
  return pixels;
}

bool mostly_within(const std::vector<double>& depths, const Interval& range) {
  const auto inside =
      std::count_if(depths.begin(), depths.end(), [&](double z) { return z >= range[0] && z <= range[1]; });
  return !depths.empty() && static_cast<double>(inside) >= kMostPoints * static_cast<double>(depths.size());
}

/// Nearest and farthest without the twentieth at either end. `depths` holds a finite one.
Interval extent_of(std::vector<double> depths) {
  depths.erase(std::remove_if(depths.begin(), depths.end(), [](double z) { return !std::isfinite(z); }),
               depths.end());
  std::sort(depths.begin(), depths.end());
  const std::size_t cut = depths.size() / 20;
  return {depths[cut], depths[depths.size() - 1 - cut]};
}

std::optional<Reach> reach_of(const std::vector<double>& depths, const Interval& range) {
  const double near_mm = kNearShare * (range[1] - range[0]);
  if (mostly_within(depths, range)) return Reach::kInside;
  if (mostly_within(depths, {range[0] - near_mm, range[1] + near_mm})) return Reach::kNear;
  if (mostly_within(depths, {range[0] / 2, range[1] * 2})) return Reach::kFar;
  return std::nullopt;
}

/// How far along the normal a surface at depth z shows the plane's light, from a pixel; mm on that surface.
double place_of_plane(const Sensor& sensor, const Plane& plane, const Vector2d& near, const Vector2d& normal,
                      double z) {
  const auto ray = unproject(sensor.camera, near);
  if (!ray) return 0;
  const Vector3d p = z * *ray;
  const double slope = plane.normal.head<2>().dot(normal);
  return std::abs(slope) > 1e-9 ? -plane.signed_distance(p) / slope : 0;
}

/// Whether plane a lies before plane b along the normal, near a pixel, at the nearest or the farthest depth
/// that is in question: planes that cross between may come in either order.
bool in_order(const Sensor& sensor, const PlaneCandidate& a, const PlaneCandidate& b, const Vector2d& near,
              const Vector2d& normal) {
  const Interval depths{std::min({sensor.depth_range_mm[0], a.depth_mm[0], b.depth_mm[0]}),
                        std::max({sensor.depth_range_mm[1], a.depth_mm[1], b.depth_mm[1]})};
  const auto place = [&](const PlaneCandidate& c, double z) {
    return place_of_plane(sensor, sensor.laser_planes[static_cast<std::size_t>(c.plane)], near, normal,
                          std::max(z, 1.0));
  };
  return std::any_of(depths.begin(), depths.end(), [&](double z) { return place(a, z) < place(b, z); });
}

/// Two lines next to each other: a pixel between them, and how far b lies behind a along the normal, px.
struct Neighbours {
  Vector2d between;
  double b_behind_a;
};

/// At that place along the lines.
Neighbours neighbours_at(const LineInImage& a, const LineInImage& b, const Vector2d& normal,
                         double along_px) {
  const Vector2d along(-normal.y(), normal.x());
  const auto nearest = [&](const LineInImage& line) {
    return *std::min_element(line.pixels.begin(), line.pixels.end(), [&](const auto& p, const auto& q) {
      return std::abs(along.dot(p) - along_px) < std::abs(along.dot(q) - along_px);
    });
  };
  const Vector2d p = nearest(a), q = nearest(b);
  return {0.5 * (p + q), normal.dot(q - p)};
}

/// Where two lines are compared: by their means, or where they cross at both ends.
std::vector<Neighbours> neighbours(const LineInImage& a, const LineInImage& b, const Vector2d& normal) {
  constexpr double kApart_px = 5;  // less at an end is no order: lines that touch
  const auto start = neighbours_at(a, b, normal, std::max(a.first, b.first));
  const auto end = neighbours_at(a, b, normal, std::min(a.last, b.last));
  const bool apart = std::min(std::abs(start.b_behind_a), std::abs(end.b_behind_a)) > kApart_px;
  if (apart && start.b_behind_a * end.b_behind_a < 0) return {start, end};
  return {{0.5 * (a.pixels[a.pixels.size() / 2] + b.pixels[b.pixels.size() / 2]), b.place - a.place}};
}

}  // namespace

Vector2d common_normal(const std::vector<Stripe>& stripes) {
  Vector2d sum = Vector2d::Zero();
  for (const auto& stripe : stripes)
    for (const auto& point : stripe.points) {
      const Vector2d n(point.normal_x, point.normal_y);
      sum += n.dot(sum) < 0 ? Vector2d(-n) : n;
    }
  return sum.norm() > 0 ? Vector2d(sum.normalized()) : Vector2d::UnitX();
}

LineInImage line_in_image(const Stripe& stripe, const Sensor& sensor, const Vector2d& normal) {
  LineInImage line;
  line.pixels = samples_of(stripe);
  line.first = std::numeric_limits<double>::infinity();
  line.last = -line.first;
  const Vector2d along(-normal.y(), normal.x());
  for (const auto& q : line.pixels) {
    line.first = std::min(line.first, along.dot(q));
    line.last = std::max(line.last, along.dot(q));
    line.place += normal.dot(q) / static_cast<double>(line.pixels.size());
  }
  std::vector<double> depths(line.pixels.size());
  for (std::size_t p = 0; p < sensor.laser_planes.size(); ++p) {
    std::transform(line.pixels.begin(), line.pixels.end(), depths.begin(),
                   [&](const Vector2d& q) { return depth_at(sensor.camera, sensor.laser_planes[p], q); });
    if (const auto reach = reach_of(depths, sensor.depth_range_mm))
      line.candidates.push_back({static_cast<int>(p), *reach, extent_of(depths)});
  }
  return line;
}

bool are_beside(const LineInImage& a, const LineInImage& b) {
  constexpr double kEnds_px = 5, kEndsShare = 0.1;
  const double common = std::min(a.last, b.last) - std::max(a.first, b.first);
  const double shorter = std::min(a.last - a.first, b.last - b.first);
  return common > std::min(kEnds_px, kEndsShare * shorter);
}

bool are_compatible(const Sensor& sensor, const LineInImage& a, const PlaneCandidate& plane_a,
                    const LineInImage& b, const PlaneCandidate& plane_b, const Vector2d& normal) {
  if (!are_beside(a, b)) return true;
  if (plane_a.plane == plane_b.plane) return false;
  const auto places = neighbours(a, b, normal);
  return std::all_of(places.begin(), places.end(), [&](const Neighbours& place) {
    return place.b_behind_a > 0 ? in_order(sensor, plane_a, plane_b, place.between, normal)
                                : in_order(sensor, plane_b, plane_a, place.between, normal);
  });
}

}  // namespace lightstripe
