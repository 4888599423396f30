// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/laser_reach.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kMostPoints = 0.9;   // of a stripe that have to lie in a plane's reach
constexpr std::size_t kSamples = 25;  // points looked at in a stripe
constexpr int kMaxTrials = 100'000;   // assignments looked at; beyond it all stripes count as ambiguous

/// What one stripe may be, and where it lies.
struct Line {
  std::vector<int> planes;                ///< that reach it
  std::vector<Vector2d> pixels;           ///< samples along it
  double first = 0, last = 0, place = 0;  ///< extent along the stripes' common direction, mean across; px
};

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

bool reaches(const Sensor& sensor, const Plane& plane, const std::vector<Vector2d>& pixels) {
  const auto inside = std::count_if(pixels.begin(), pixels.end(), [&](const Vector2d& q) {
    const double z = depth_at(sensor.camera, plane, q);
    return z >= sensor.depth_range_mm[0] && z <= sensor.depth_range_mm[1];
  });
  return !pixels.empty() && static_cast<double>(inside) >= kMostPoints * static_cast<double>(pixels.size());
}

/// Unit normal of the stripes in the image: the mean direction across them, signs made equal.
Vector2d common_normal(const std::vector<Stripe>& stripes) {
  Vector2d sum = Vector2d::Zero();
  for (const auto& stripe : stripes)
    for (const auto& point : stripe.points) {
      const Vector2d n(point.normal_x, point.normal_y);
      sum += n.dot(sum) < 0 ? Vector2d(-n) : n;
    }
  return sum.norm() > 0 ? Vector2d(sum.normalized()) : Vector2d::UnitX();
}

Line line_of(const Stripe& stripe, const Sensor& sensor, const Vector2d& normal) {
  Line line;
  line.pixels = samples_of(stripe);
  line.first = std::numeric_limits<double>::infinity();
  line.last = -line.first;
  const Vector2d along(-normal.y(), normal.x());
  for (const auto& q : line.pixels) {
    line.first = std::min(line.first, along.dot(q));
    line.last = std::max(line.last, along.dot(q));
    line.place += normal.dot(q) / static_cast<double>(line.pixels.size());
  }
  for (std::size_t p = 0; p < sensor.laser_planes.size(); ++p)
    if (reaches(sensor, sensor.laser_planes[p], line.pixels)) line.planes.push_back(static_cast<int>(p));
  return line;
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

/// Whether plane a lies before plane b along the normal, near a pixel, at the nearest or the farthest depth:
/// planes that cross within the range may come in either order.
bool in_order(const Sensor& sensor, int a, int b, const Vector2d& near, const Vector2d& normal) {
  const auto& planes = sensor.laser_planes;
  return std::any_of(sensor.depth_range_mm.begin(), sensor.depth_range_mm.end(), [&](double z) {
    return place_of_plane(sensor, planes[static_cast<std::size_t>(a)], near, normal, std::max(z, 1.0)) <
           place_of_plane(sensor, planes[static_cast<std::size_t>(b)], near, normal, std::max(z, 1.0));
  });
}

bool beside(const Line& a, const Line& b) { return std::min(a.last, b.last) > std::max(a.first, b.first); }

/// Two lines next to each other: a pixel between them, and how far b lies behind a along the normal, px.
struct Neighbours {
  Vector2d between;
  double b_behind_a;
};

/// At that place along the lines.
Neighbours neighbours_at(const Line& a, const Line& b, const Vector2d& normal, double along_px) {
  const Vector2d along(-normal.y(), normal.x());
  const auto nearest = [&](const Line& line) {
    return *std::min_element(line.pixels.begin(), line.pixels.end(), [&](const auto& p, const auto& q) {
      return std::abs(along.dot(p) - along_px) < std::abs(along.dot(q) - along_px);
    });
  };
  const Vector2d p = nearest(a), q = nearest(b);
  return {0.5 * (p + q), normal.dot(q - p)};
}

/// Where two lines are compared: by their means, or where they cross at both ends.
std::vector<Neighbours> neighbours(const Line& a, const Line& b, const Vector2d& normal) {
  constexpr double kApart_px = 5;  // less at an end is no order: lines that touch
  const auto start = neighbours_at(a, b, normal, std::max(a.first, b.first));
  const auto end = neighbours_at(a, b, normal, std::min(a.last, b.last));
  const bool apart = std::min(std::abs(start.b_behind_a), std::abs(end.b_behind_a)) > kApart_px;
  if (apart && start.b_behind_a * end.b_behind_a < 0) return {start, end};
  return {{0.5 * (a.pixels[a.pixels.size() / 2] + b.pixels[b.pixels.size() / 2]), b.place - a.place}};
}

bool compatible(const Sensor& sensor, const Line& a, int plane_a, const Line& b, int plane_b,
                const Vector2d& normal) {
  if (!beside(a, b)) return true;
  if (plane_a == plane_b) return false;
  const auto places = neighbours(a, b, normal);
  return std::all_of(places.begin(), places.end(), [&](const Neighbours& place) {
    return place.b_behind_a > 0 ? in_order(sensor, plane_a, plane_b, place.between, normal)
                                : in_order(sensor, plane_b, plane_a, place.between, normal);
  });
}

/// Walks all assignments that hold; notes for each line which planes it gets in them.
struct Search {
  const Sensor& sensor;
  const std::vector<Line>& lines;
  Vector2d normal;
  std::vector<int> chosen;
  std::vector<std::vector<bool>> possible;
  int trials = 0;

  bool given_up() const { return trials > kMaxTrials; }

  void from(std::size_t i) {
    if (given_up()) return;
    if (i == lines.size()) {
      for (std::size_t k = 0; k < lines.size(); ++k)
        if (chosen[k] >= 0) possible[k][static_cast<std::size_t>(chosen[k])] = true;
      return;
    }
    if (lines[i].planes.empty()) return from(i + 1);  // no plane's light: it says nothing about the others
    for (const int plane : lines[i].planes) {
      ++trials;
      bool fits = true;
      for (std::size_t k = 0; fits && k < i; ++k)
        fits = chosen[k] < 0 || compatible(sensor, lines[k], chosen[k], lines[i], plane, normal);
      if (!fits) continue;
      chosen[i] = plane;
      from(i + 1);
      chosen[i] = -1;
    }
  }
};

}  // namespace

std::vector<std::optional<int>> assign_by_reach(const std::vector<Stripe>& stripes, const Sensor& sensor) {
  const Vector2d normal = common_normal(stripes);
  std::vector<Line> lines;
  for (const auto& stripe : stripes) lines.push_back(line_of(stripe, sensor, normal));
  Search search{
      sensor, lines, normal, std::vector<int>(lines.size(), -1),
      std::vector<std::vector<bool>>(lines.size(), std::vector<bool>(sensor.laser_planes.size(), false))};
  search.from(0);
  std::vector<std::optional<int>> result(stripes.size());
  for (std::size_t i = 0; i < lines.size() && !search.given_up(); ++i) {
    const auto& possible = search.possible[i];
    if (std::count(possible.begin(), possible.end(), true) == 1)
      result[i] = static_cast<int>(std::find(possible.begin(), possible.end(), true) - possible.begin());
  }
  return result;
}

}  // namespace lightstripe
