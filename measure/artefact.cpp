// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/artefact.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "core/counted.h"
#include "core/error.h"
#include "core/linear_algebra.h"
#include "core/random.h"
#include "core/robust.h"
#include "measure/artefact_fit.h"
#include "measure/artefact_search.h"

namespace lightstripe {
namespace {

using Eigen::Vector3d;

constexpr int kMinPoints = 30, kMinGroups = 4;
constexpr double kTrimSigmas = 4;
constexpr double kSizeTolerance = 0.2;
constexpr double kMostScatter = 0.005, kMostSigma = 0.01;  // of the known size

/// The points that a shape explains, with the group of each.
struct Used {
  Points3 points;
  std::vector<int> groups;
  std::vector<int> faces;  ///< of a step: 0 or 1

  void add(const Vector3d& p, int group, int face = 0) {
    points.push_back(p), groups.push_back(group), faces.push_back(face);
  }
};

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
                                : std::min(width, std::max(kTrimSigmas * sigma_of(distances), 1e-6));
  }
  return body;
}

/// Whether the points reach far enough about the body: on a small cap everything flat is a ball.
bool is_seen_well(const Used& used, const RoundBody& body) {
  constexpr double kMostPoints = 0.9, kLeastReach = 0.4;  // rad
  std::vector<Vector3d> normals;
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& p : used.points) mean += normals.emplace_back(body.way_out(p).normalized());
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

/// The middle of each face in each group: what lies next to an edge is rounded by lens and light. (ISO 5436-1
/// takes the middle third of a groove for the same reason.)
Used middles_of(const Used& used) {
  constexpr double kLeftOut = 1.0 / 6;  // at either end
  Used out;
  for (std::size_t first = 0, last; first < used.points.size(); first = last) {
    std::array<std::vector<std::size_t>, 2> face;
    for (last = first; last < used.points.size() && used.groups[last] == used.groups[first]; ++last)
      face[static_cast<std::size_t>(used.faces[last])].push_back(last);
    for (const auto& indices : face) {
      const auto ends = static_cast<std::size_t>(kLeftOut * static_cast<double>(indices.size()));
      for (std::size_t i = ends; i + ends < indices.size(); ++i)
        out.add(used.points[indices[i]], used.groups[indices[i]], used.faces[indices[i]]);
    }
  }
  return out;
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
    if (!spec.section) used = middles_of(used);
    if (!has_both_faces(used)) return faces;
    faces = fit_step(used, !spec.section);
    for (std::size_t i = 0; i < used.points.size(); ++i)
      distances.push_back(faces.distance(used.points[i], used.faces[i]));
    width = std::min(width, std::max(kTrimSigmas * sigma_of(distances), 1e-6));
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

/// The same points in eight groups by their place along where they reach farthest: an error that changes
/// along the body is no scatter from frame to frame, but shows when a part of the body is left out.
Used grouped_by_place(Used used, Points3 places) {
  constexpr std::size_t kParts = 8;
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& p : places) mean += p / static_cast<double>(places.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (Vector3d& p : places) p -= mean, spread += p * p.transpose();
  const Vector3d along = symmetric_eigen(spread).vectors.col(2);
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return along.dot(places[i]) < along.dot(places[j]); });
  Used out;
  for (std::size_t rank = 0; rank < order.size(); ++rank)
    out.add(used.points[order[rank]], static_cast<int>(rank * kParts / order.size()),
            used.faces[order[rank]]);
  return out;
}

/// `places`: where on the body each used point lies.
template <class SizeOf, class DistanceOf>
std::optional<ArtefactMeasurement> measured(const Used& used, const Points3& places, const SizeOf& size_of,
                                            const DistanceOf& distance_of, std::string& why_not) {
  const auto by_group = jackknife_sigma(used, size_of),
             by_place = jackknife_sigma(grouped_by_place(used, places), size_of);
  if (!by_group || !by_place) {
    why_not = "too little of the body is seen to tell its size";
    return std::nullopt;
  }
  double sum = 0;
  for (std::size_t i = 0; i < used.points.size(); ++i) sum += std::pow(distance_of(i), 2);
  return ArtefactMeasurement{size_of(used), std::max(*by_group, *by_place),
                             std::sqrt(sum / static_cast<double>(used.points.size())),
                             static_cast<int>(used.points.size()), Vector3d::Zero()};
}

/// What looks like the body by chance (a ball in a rail's corner, two of many faces) does not lie on its
/// shape, or changes its size with the part that is looked at.
bool is_the_body(const ArtefactMeasurement& m, const ArtefactSpec& spec) {
  return m.scatter_mm <= kMostScatter * spec.size_mm && m.sigma_mm <= kMostSigma * spec.size_mm;
}

std::optional<ArtefactMeasurement> measure_step(const Points3& points, const std::vector<int>& groups,
                                                const ArtefactSpec& spec, std::string& why_not) {
  const auto found = find_step(points, spec);
  Used used;
  const auto faces = found ? refine_step(points, groups, spec, *found, used) : ParallelFaces{};
  const double height = std::abs(faces.offset[1] - faces.offset[0]);
  if (!found || !has_both_faces(used) || std::abs(height - spec.size_mm) > kStepTolerance * spec.size_mm) {
    why_not = fmt::format("no two parallel faces about {:g} mm apart are in the points", spec.size_mm);
    return std::nullopt;
  }
  return measured(
      used, used.points,
      [&](const Used& some) { return has_both_faces(some) ? step_size(some, spec) : step_size(used, spec); },
      [&](std::size_t i) { return faces.distance(used.points[i], used.faces[i]); }, why_not);
}

std::optional<ArtefactMeasurement> measure_round(const Points3& points, const std::vector<int>& groups,
                                                 const ArtefactSpec& spec, std::string& why_not) {
  const Points3 few = points_to_search(points, spec);
  Used used;
  RoundBody body;
  double most = 0;
  for (const auto& axes : axes_of_round_body(spec)) {
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
  Points3 normals;
  for (const Vector3d& p : used.points) normals.push_back(body.way_out(p).normalized());
  auto out = measured(
      used, normals, [&](const Used& some) { return round_size(some, spec, body); },
      [&](std::size_t i) { return body.distance(used.points[i]); }, why_not);
  if (out) out->axis = body.axis;
  return out;
}

}  // namespace

std::optional<ArtefactMeasurement> measure_artefact(const Points3& points, const std::vector<int>& groups,
                                                    const ArtefactSpec& spec, std::string& why_not) {
  LIGHTSTRIPE_CHECK(points.size() == groups.size(), "one group a point");
  LIGHTSTRIPE_CHECK(spec.size_mm > 0, "a body has a size");
  LIGHTSTRIPE_CHECK(!(spec.section && spec.kind == Artefact::kSphere),
                    "one section does not tell a ball's size");
  if (points.size() < static_cast<std::size_t>(kMinPoints)) {
    why_not = fmt::format("only {} measured", counted(points.size(), "point was", "points were"));
    return std::nullopt;
  }
  auto found = spec.kind == Artefact::kStep ? measure_step(points, groups, spec, why_not)
                                            : measure_round(points, groups, spec, why_not);
  if (found && !is_the_body(*found, spec)) {
    why_not = fmt::format(
        "no {} of {:g} mm is in the points: what comes nearest has {:.4g} mm with a sigma of {:.2g} mm, and "
        "scatters by "
        "{:.2g} mm about its shape",
        enum_name(spec.kind), spec.size_mm, found->size_mm, found->sigma_mm, found->scatter_mm);
    found.reset();
  }
  return found;
}

}  // namespace lightstripe
