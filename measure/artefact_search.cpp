// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/artefact_search.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/random.h"

namespace lightstripe {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kSearchPoints = 3000;
constexpr int kTrials = 1500, kBallTrials = 8000, kMinSurfacePoints = 30;
constexpr double kFirstTolerance = 0.05;

Points3 thinned(const Points3& points, std::size_t most) {
  Points3 out;
  const std::size_t step = std::max<std::size_t>(1, points.size() / most);
  for (std::size_t i = 0; i < points.size(); i += step) out.push_back(points[i]);
  return out;
}

std::size_t any_index(Random& random, std::size_t size) {
  return std::min(size - 1, static_cast<std::size_t>(random.uniform() * static_cast<double>(size)));
}

/// Points about one of them, no farther than the body is large: the rest of the scene does not dilute them.
template <std::size_t kCount>
std::optional<std::array<Vector3d, kCount>> points_nearby(const Points3& points, double reach,
                                                          Random& random) {
  constexpr int kTries = 60;
  std::array<Vector3d, kCount> out;
  out[0] = points[any_index(random, points.size())];
  std::size_t found = 1;
  for (int i = 0; i < kTries && found < kCount; ++i) {
    const Vector3d& p = points[any_index(random, points.size())];
    if ((p - out[0]).norm() < reach) out[found++] = p;
  }
  return found == kCount ? std::optional(out) : std::nullopt;
}

// ---- round bodies

/// Circle through three points seen along the axis, as a cylinder; the ball through four. Radius 0: none.
RoundBody circle_through(const std::array<Vector3d, 4>& p, const Vector3d& axis) {
  const Vector3d e1 = axis.unitOrthogonal(), e2 = axis.cross(e1);
  Eigen::Matrix2d a;
  Eigen::Vector2d b;
  const auto flat = [&](const Vector3d& q) { return Eigen::Vector2d(e1.dot(q), e2.dot(q)); };
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d d = flat(p[static_cast<std::size_t>(i) + 1]) - flat(p[0]);
    a.row(i) = 2 * d.transpose();
    b(i) = d.squaredNorm();
  }
  const Eigen::Vector2d c = a.inverse() * b;
  if (!c.allFinite()) return {};
  return {p[0] - axis * axis.dot(p[0]) + c.x() * e1 + c.y() * e2, axis, c.norm()};
}

RoundBody ball_through(const std::array<Vector3d, 4>& p) {
  Eigen::Matrix3d a;
  Vector3d b;
  for (int i = 0; i < 3; ++i) {
    const Vector3d d = p[static_cast<std::size_t>(i) + 1] - p[0];
    a.row(i) = 2 * d.transpose();
    b(i) = d.squaredNorm();
  }
  const Vector3d c = a.inverse() * b;
  if (!c.allFinite()) return {};
  return {p[0] + c, Vector3d::Zero(), c.norm()};
}

/// Normal of a face through three points (of a section: two and the travel).
Vector3d face_normal(const std::array<Vector3d, 3>& p, bool section) {
  const Vector3d along = section ? Vector3d::UnitX() : Vector3d(p[2] - p[0]);
  return (p[1] - p[0]).cross(along).normalized();
}

/// Without the plane (of a section: the straight line) that most bodies stand on, where it holds a third of
/// the points or more.
Points3 without_ground(const Points3& points, const ArtefactSpec& spec) {
  constexpr int kGroundTrials = 200;
  constexpr double kLeastShare = 1.0 / 3;
  const double width = 0.01 * spec.size_mm;
  Random random(3);
  ParallelFaces ground;
  std::ptrdiff_t most = 0;
  for (int trial = 0; trial < kGroundTrials; ++trial) {
    const std::array<Vector3d, 3> three{points[any_index(random, points.size())],
                                        points[any_index(random, points.size())],
                                        points[any_index(random, points.size())]};
    ParallelFaces faces;
    faces.normal = face_normal(three, spec.section);
    if (!faces.normal.allFinite()) continue;
    faces.offset[0] = faces.normal.dot(three[0]);
    const auto on_it = std::count_if(points.begin(), points.end(), [&](const Vector3d& p) {
      return std::abs(faces.distance(p, 0)) < width;
    });
    if (on_it > most) most = on_it, ground = faces;
  }
  Points3 rest;
  if (static_cast<double>(most) > kLeastShare * static_cast<double>(points.size()))
    std::copy_if(points.begin(), points.end(), std::back_inserter(rest),
                 [&](const Vector3d& p) { return std::abs(ground.distance(p, 0)) >= width; });
  return rest.size() >= static_cast<std::size_t>(kMinSurfacePoints) ? rest : points;
}

// ---- steps

/// The second face's offset: the window as wide as `width` about it that holds most points, at about the
/// known height on either side.
std::array<double, 2> best_partner(const std::vector<double>& distances, double height, double width) {
  std::vector<double> candidates;
  for (const double d : distances)
    if (std::abs(std::abs(d) - height) < kStepTolerance * height) candidates.push_back(d);
  std::sort(candidates.begin(), candidates.end());
  std::array<double, 2> best{0, 0};  // offset, points
  std::size_t last = 0;
  for (std::size_t first = 0; first < candidates.size(); ++first) {
    while (last < candidates.size() && candidates[last] < candidates[first] + 2 * width) ++last;
    const auto count = static_cast<double>(last - first);
    if (count > best[1]) best = {candidates[(first + last - 1) / 2], count};
  }
  return best;
}

}  // namespace

Points3 points_to_search(const Points3& points, const ArtefactSpec& spec) {
  return thinned(without_ground(thinned(points, 4 * kSearchPoints), spec), kSearchPoints);
}

std::vector<std::vector<Vector3d>> axes_of_round_body(const ArtefactSpec& spec) {
  if (spec.kind == Artefact::kSphere) return {{Vector3d::Zero()}};
  if (spec.section) return {{Vector3d::UnitX()}};
  constexpr int kTilts = 3;
  constexpr double kTilt = 0.1;  // rad
  std::vector<std::vector<Vector3d>> all(3);
  for (int base = 0; base < 3; ++base)
    for (int i = -kTilts; i <= kTilts; ++i)
      for (int j = -kTilts; j <= kTilts; ++j) {
        Vector3d axis;
        axis(base) = 1, axis((base + 1) % 3) = kTilt * i, axis((base + 2) % 3) = kTilt * j;
        all[static_cast<std::size_t>(base)].push_back(axis.normalized());
      }
  return all;
}

double support_of(const Points3& points, const RoundBody& body, double width) {
  double sum = 0;
  for (const Vector3d& q : points) sum += std::max(0.0, 1 - std::pow(body.distance(q) / width, 2));
  return sum;
}

RoundBody find_round_body(const Points3& points, const ArtefactSpec& spec,
                          const std::vector<Vector3d>& axes) {
  const double radius = spec.size_mm / 2;
  const int trials =
      spec.kind == Artefact::kSphere ? kBallTrials : kTrials / std::min(10, static_cast<int>(axes.size()));
  RoundBody best;
  double most = 0;
  Random random(1);
  for (const Vector3d& axis : axes)
    for (int trial = 0; trial < trials; ++trial) {
      const auto p = points_nearby<4>(points, spec.size_mm, random);
      if (!p) continue;
      const RoundBody body = axis.isZero() ? ball_through(*p) : circle_through(*p, axis);
      if (std::abs(body.radius - radius) > kFirstTolerance * radius) continue;
      const double support = support_of(points, body, 0.04 * radius);
      if (support > most) most = support, best = body;
    }
  return best;
}

std::optional<ParallelFaces> find_step(const Points3& all, const ArtefactSpec& spec) {
  const Points3 points = thinned(all, kSearchPoints);
  const double width = 0.05 * spec.size_mm;
  std::optional<ParallelFaces> best;
  double most = 0;
  Random random(2);
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto p = points_nearby<3>(points, 10 * spec.size_mm, random);
    if (!p) continue;
    ParallelFaces faces;
    faces.normal = face_normal(*p, spec.section);
    if (!faces.normal.allFinite()) continue;
    faces.offset[0] = faces.normal.dot((*p)[0]);
    std::vector<double> distances;
    for (const Vector3d& q : points) distances.push_back(faces.distance(q, 0));
    const auto near = [&](double d) { return std::abs(d) < width; };
    const auto on_first = static_cast<double>(std::count_if(distances.begin(), distances.end(), near));
    const auto [offset, on_second] = best_partner(distances, spec.size_mm, width);
    const double support = std::min(on_first, on_second) + 0.1 * (on_first + on_second);
    if (on_second < 1 || support <= most) continue;
    most = support;
    faces.offset[1] = faces.offset[0] + offset;
    best = faces;
  }
  return best;
}

}  // namespace lightstripe
