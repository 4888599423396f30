// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/artefact.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/random.h"
#include "core/robust.h"
#include "measure/artefact_fit.h"

namespace lightstripe {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kSearchPoints = 3000;  // looked at by the search
constexpr int kTrials = 1500;
constexpr int kMinPoints = 30, kMinGroups = 4;
constexpr double kTrim_sigmas = 4;
constexpr double kFirstTolerance = 0.05, kSizeTolerance = 0.2, kHeightTolerance = 0.33;

/// The points that a shape explains, with the group of each.
struct Used {
  Points3 points;
  std::vector<int> groups;
  std::vector<int> faces;  ///< of a step: 0 or 1

  void add(const Vector3d& p, int group, int face = 0) {
    points.push_back(p), groups.push_back(group), faces.push_back(face);
  }
};

Points3 thinned(const Points3& points) {
  Points3 out;
  const std::size_t step = std::max<std::size_t>(1, points.size() / kSearchPoints);
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

/// Directions about one of the rig's axes, 6 degrees apart; of a ball none, of a section the travel.
std::vector<std::vector<Vector3d>> axes_to_try(const ArtefactSpec& spec) {
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

/// How well the body explains the points: 1 for each on its surface, 0 from `width` on (MSAC: Torr and
/// Zisserman 2000).
double support_of(const Points3& points, const RoundBody& body, double width) {
  double sum = 0;
  for (const Vector3d& q : points) sum += std::max(0.0, 1 - std::pow(body.distance(q) / width, 2));
  return sum;
}

/// The body near the known size that explains most points. A cylinder at a slant to the axis is seen as an
/// ellipse first: hence the width of what counts.
RoundBody find_round_body(const Points3& points, const ArtefactSpec& spec,
                          const std::vector<Vector3d>& axes) {
  const double radius = spec.size_mm / 2;
  const int trials = kTrials / std::min(10, static_cast<int>(axes.size()));
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

double sigma_of(std::vector<double> distances) {
  for (double& d : distances) d = std::abs(d);
  return kMadToSigma * median(std::move(distances));
}

/// Fits and leaves out what lies far, first generously: an axis at a slant turns towards its points.
RoundBody refine(const Points3& points, const std::vector<int>& groups, const ArtefactSpec& spec,
                 RoundBody body, Used& used) {
  constexpr int kRounds = 14, kWideRounds = 4;
  constexpr double kNarrower = 0.75;
  double width = 0.1 * body.radius;
  for (int round = 0; round < kRounds; ++round) {
    used = {};
    std::vector<double> distances;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (std::abs(body.distance(points[i])) < width) used.add(points[i], groups[i]);
    if (used.points.size() < static_cast<std::size_t>(kMinPoints)) return body;
    body = fit_round_body(used.points, body, !spec.section);
    for (const Vector3d& p : used.points) distances.push_back(body.distance(p));
    width = round < kWideRounds ? kNarrower * width
                                : std::min(width, std::max(kTrim_sigmas * sigma_of(distances), 1e-6));
  }
  return body;
}

/// Whether the points reach far enough about the body: on a small cap everything flat is a ball.
bool is_seen_well(const Used& used, const RoundBody& body) {
  constexpr double kMostPoints = 0.9, kLeastReach = 0.4;  // rad
  std::vector<Vector3d> normals;
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& p : used.points) {
    const Vector3d from = p - body.center;
    mean += normals.emplace_back((from - body.axis * body.axis.dot(from)).normalized());
  }
  mean.normalize();
  std::vector<double> cosines;
  for (const Vector3d& n : normals) cosines.push_back(n.dot(mean));
  const auto rank = static_cast<std::size_t>((1 - kMostPoints) * static_cast<double>(cosines.size()));
  return value_at_rank(cosines, rank) < std::cos(kLeastReach);
}

double round_size(const Used& used, const ArtefactSpec& spec, const RoundBody& start) {
  return 2 * fit_round_body(used.points, start, !spec.section).radius;
}

// ---- steps

/// Normal of a face through three points (of a section: two and the travel).
Vector3d face_normal(const std::array<Vector3d, 3>& p, bool section) {
  const Vector3d along = section ? Vector3d::UnitX() : Vector3d(p[2] - p[0]);
  return (p[1] - p[0]).cross(along).normalized();
}

/// The second face's offset: the window as wide as `width` about it that holds most points, at about the
/// known height on either side.
std::array<double, 2> best_partner(const std::vector<double>& distances, double height, double width) {
  std::vector<double> candidates;
  for (const double d : distances)
    if (std::abs(std::abs(d) - height) < kHeightTolerance * height) candidates.push_back(d);
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

std::optional<ParallelFaces> find_step(const Points3& points, const ArtefactSpec& spec) {
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

ParallelFaces fit_step(const Used& used, bool whole) {
  std::array<Points3, 2> faces;
  for (std::size_t i = 0; i < used.points.size(); ++i)
    faces[static_cast<std::size_t>(used.faces[i])].push_back(used.points[i]);
  return fit_parallel_faces(faces[0], faces[1], whole);
}

bool has_both_faces(const Used& used) {
  const auto second = std::count(used.faces.begin(), used.faces.end(), 1);
  return second >= kMinPoints / 2 &&
         static_cast<std::ptrdiff_t>(used.faces.size()) - second >= kMinPoints / 2;
}

ParallelFaces refine_step(const Points3& points, const std::vector<int>& groups, const ArtefactSpec& spec,
                          ParallelFaces faces, Used& used) {
  constexpr int kRounds = 12;
  double width = 0.1 * spec.size_mm;
  for (int round = 0; round < kRounds; ++round) {
    used = {};
    std::vector<double> distances;
    for (std::size_t i = 0; i < points.size(); ++i)
      for (int face = 0; face < 2; ++face)
        if (std::abs(faces.distance(points[i], face)) < width) used.add(points[i], groups[i], face);
    if (!has_both_faces(used)) return faces;
    faces = fit_step(used, !spec.section);
    for (std::size_t i = 0; i < used.points.size(); ++i)
      distances.push_back(faces.distance(used.points[i], used.faces[i]));
    width = std::min(width, std::max(kTrim_sigmas * sigma_of(distances), 1e-6));
  }
  return faces;
}

double step_size(const Used& used, const ArtefactSpec& spec) {
  const ParallelFaces faces = fit_step(used, !spec.section);
  return std::abs(faces.offset[1] - faces.offset[0]);
}

// ---- both

Used without_group(const Used& all, int group) {
  Used out;
  for (std::size_t i = 0; i < all.points.size(); ++i)
    if (all.groups[i] != group) out.add(all.points[i], all.groups[i], all.faces[i]);
  return out;
}

/// Delete-one-group jackknife. Many groups are joined to at most 40 that follow each other.
template <class SizeOf>
std::optional<double> jackknife_sigma(Used used, const SizeOf& size_of) {
  constexpr int kMost = 40;
  std::vector<int> names = used.groups;
  names.erase(std::unique(names.begin(), names.end()), names.end());
  const auto count = static_cast<int>(names.size());
  const int parts = std::min(count, kMost);
  if (parts < kMinGroups) return std::nullopt;
  for (int& group : used.groups)
    group =
        static_cast<int>(std::lower_bound(names.begin(), names.end(), group) - names.begin()) * parts / count;
  std::vector<double> sizes;
  double mean = 0;
  for (int part = 0; part < parts; ++part) sizes.push_back(size_of(without_group(used, part)));
  for (const double size : sizes) mean += size / parts;
  double sum = 0;
  for (const double size : sizes) sum += (size - mean) * (size - mean);
  return std::sqrt(sum * (parts - 1) / parts);
}

template <class SizeOf, class DistanceOf>
std::optional<ArtefactMeasurement> measured(const Used& used, const SizeOf& size_of,
                                            const DistanceOf& distance_of, std::string& why_not) {
  const auto sigma = jackknife_sigma(used, size_of);
  if (!sigma) {
    why_not = "too little of the body is seen to tell its size";
    return std::nullopt;
  }
  double sum = 0;
  for (std::size_t i = 0; i < used.points.size(); ++i) sum += std::pow(distance_of(i), 2);
  return ArtefactMeasurement{size_of(used), *sigma, std::sqrt(sum / static_cast<double>(used.points.size())),
                             static_cast<int>(used.points.size())};
}

std::optional<ArtefactMeasurement> measure_step(const Points3& points, const std::vector<int>& groups,
                                                const ArtefactSpec& spec, std::string& why_not) {
  const auto found = find_step(thinned(points), spec);
  Used used;
  const auto faces = found ? refine_step(points, groups, spec, *found, used) : ParallelFaces{};
  const double height = std::abs(faces.offset[1] - faces.offset[0]);
  if (!found || !has_both_faces(used) || std::abs(height - spec.size_mm) > kHeightTolerance * spec.size_mm) {
    why_not = fmt::format("no two parallel faces about {:g} mm apart are in the points", spec.size_mm);
    return std::nullopt;
  }
  return measured(
      used,
      [&](const Used& some) { return has_both_faces(some) ? step_size(some, spec) : step_size(used, spec); },
      [&](std::size_t i) { return faces.distance(used.points[i], used.faces[i]); }, why_not);
}

std::optional<ArtefactMeasurement> measure_round(const Points3& points, const std::vector<int>& groups,
                                                 const ArtefactSpec& spec, std::string& why_not) {
  const Points3 few = thinned(points);
  Used used;
  RoundBody body;
  double most = 0;
  for (const auto& axes : axes_to_try(spec)) {
    const RoundBody found = find_round_body(few, spec, axes);
    if (found.radius <= 0) continue;
    Used with;
    const RoundBody fitted = refine(points, groups, spec, found, with);
    const bool is_one = with.points.size() >= static_cast<std::size_t>(kMinPoints) &&
                        is_seen_well(with, fitted) &&
                        std::abs(2 * fitted.radius - spec.size_mm) <= kSizeTolerance * spec.size_mm;
    const double support = is_one ? support_of(points, fitted, 0.01 * spec.size_mm) : 0;
    if (support > most) most = support, body = fitted, used = std::move(with);
  }
  if (most <= 0) {
    why_not = fmt::format("no {} of about {:g} mm diameter is in the points",
                          spec.kind == Artefact::kSphere ? "sphere" : "cylinder", spec.size_mm);
    return std::nullopt;
  }
  return measured(
      used, [&](const Used& some) { return round_size(some, spec, body); },
      [&](std::size_t i) { return body.distance(used.points[i]); }, why_not);
}

}  // namespace

std::optional<ArtefactMeasurement> measure_artefact(const Points3& points, const std::vector<int>& groups,
                                                    const ArtefactSpec& spec, std::string& why_not) {
  LIGHTSTRIPE_CHECK(points.size() == groups.size(), "one group a point");
  LIGHTSTRIPE_CHECK(spec.size_mm > 0, "a body has a size");
  LIGHTSTRIPE_CHECK(!(spec.section && spec.kind == Artefact::kSphere),
                    "one section does not tell a ball's size");
  if (points.size() < static_cast<std::size_t>(kMinPoints)) {
    why_not = fmt::format("only {} points were measured", points.size());
    return std::nullopt;
  }
  return spec.kind == Artefact::kStep ? measure_step(points, groups, spec, why_not)
                                      : measure_round(points, groups, spec, why_not);
}

}  // namespace lightstripe
