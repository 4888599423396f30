// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "simulate/surfaces.h"

#include <algorithm>
#include <cmath>

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kTouching = 1e-7;  // share of a distance below which a hit is where the ray begins or ends

void keep_nearer(std::optional<SurfaceHit>& nearest, const SurfaceHit& hit) {
  if (!nearest || hit.s < nearest->s) nearest = hit;
}

/// The albedo at a place of the board's plane; nothing beyond its rim.
std::optional<double> board_albedo(const BoardSurface& board, double x, double y) {
  const double column = x / board.target.pitch_x + 1,
               row = y / board.target.pitch_y + 1;  // 0 at the outer square's edge
  const double columns = board.target.columns + 1, rows = board.target.rows + 1;
  if (column >= 0 && row >= 0 && column < columns && row < rows) {
    const bool black = (static_cast<int>(column) + static_cast<int>(row)) % 2 != 0;
    return black ? board.black_albedo : board.white_albedo;
  }
  const double rim_x = board.quiet_border_mm / board.target.pitch_x,
               rim_y = board.quiet_border_mm / board.target.pitch_y;
  if (column < -rim_x || row < -rim_y || column > columns + rim_x || row > rows + rim_y) return std::nullopt;
  return board.white_albedo;
}

void meet_board(const BoardSurface& board, const Ray& ray, std::optional<SurfaceHit>& nearest) {
  const Eigen::Matrix3d R = board.world_from_board.rotation.toRotationMatrix();
  const Vector3d normal = R.col(2);
  const double falling = normal.dot(ray.direction);
  if (falling == 0) return;
  const double s = normal.dot(board.world_from_board.translation - ray.origin) / falling;
  if (s <= 0) return;
  const Vector3d offset = ray.at(s) - board.world_from_board.translation;
  const std::optional<double> albedo = board_albedo(board, R.col(0).dot(offset), R.col(1).dot(offset));
  if (!albedo) return;
  // Seen from behind a board is plain dark.
  keep_nearer(
      nearest,
      {s, falling > 0 ? Vector3d(-normal) : normal, {falling > 0 ? *albedo : board.black_albedo, 0, 1}});
}

/// A circle around a run of segments.
BoundedRun bounded(const Outline& segments) {
  BoundedRun run{segments, Vector2d::Zero(), 0};
  const std::vector<OutlineSample> points = sample(segments, 1.0);
  Vector2d low = points.front().position, high = low;
  for (const OutlineSample& point : points) {
    low = low.cwiseMin(point.position);
    high = high.cwiseMax(point.position);
  }
  run.center = 0.5 * (low + high);
  for (const OutlineSample& point : points)
    run.radius = std::max(run.radius, (point.position - run.center).norm());
  run.radius += 1.0;  // samples lie at most that far apart
  return run;
}

bool misses(const BoundedRun& run, const Vector2d& origin, const Vector2d& direction) {
  const Vector2d to_center = run.center - origin;
  const double offset = direction.x() * to_center.y() - direction.y() * to_center.x();
  return offset * offset > run.radius * run.radius * direction.squaredNorm();
}

/// As first_hit() of the whole outline.
std::optional<OutlineHit> first_hit_of_runs(const Extrusion& solid, const Vector2d& origin,
                                            const Vector2d& direction, double min_s) {
  std::optional<OutlineHit> nearest;
  for (const BoundedRun& run : solid.runs) {
    if (misses(run, origin, direction)) continue;
    const std::optional<OutlineHit> hit = first_hit(run.segments, origin, direction, min_s);
    if (hit && (!nearest || hit->s < nearest->s)) nearest = hit;
  }
  return nearest;
}

/// The flat ends of an extrusion of finite length.
void meet_caps(const Extrusion& solid, const Ray& local, const Eigen::Matrix3d& R,
               std::optional<SurfaceHit>& nearest) {
  for (const double end : {-0.5, 0.5}) {
    const double s = (end * solid.length_mm - local.origin.x()) / local.direction.x();
    if (!(s > 0) || !std::isfinite(s)) continue;
    const Vector3d p = local.at(s);
    const Vector2d place(p.y(), p.z());
    if ((place - solid.outline.center).norm() > solid.outline.radius) continue;
    if (!contains(solid.outline.segments, place)) continue;
    keep_nearer(nearest,
                {s, local.direction.x() > 0 ? Vector3d(-R.col(0)) : Vector3d(R.col(0)), solid.material});
  }
}

void meet_extrusion(const Extrusion& solid, const Ray& ray, std::optional<SurfaceHit>& nearest) {
  const Eigen::Matrix3d R = solid.world_from_solid.rotation.toRotationMatrix();
  const Ray local{R.transpose() * (ray.origin - solid.world_from_solid.translation),
                  R.transpose() * ray.direction};
  const Vector2d origin(local.origin.y(), local.origin.z()),
      direction(local.direction.y(), local.direction.z());
  if (misses(solid.outline, origin, direction)) return;
  if (solid.length_mm > 0) meet_caps(solid, local, R, nearest);
  double after = 0;
  // Beyond an end of the solid its mantle does not count: look for the next crossing.
  while (const std::optional<OutlineHit> hit = first_hit_of_runs(solid, origin, direction, after)) {
    const double x = local.at(hit->s).x();
    if (solid.length_mm == 0 || std::abs(x) <= solid.length_mm / 2) {
      Vector3d normal = R * Vector3d(0, hit->normal.x(), hit->normal.y());
      if (normal.dot(ray.direction) > 0) normal = -normal;
      return keep_nearer(nearest, {hit->s, normal, solid.material});
    }
    after = hit->s * (1 + kTouching);
  }
}

void meet_sphere(const SphereObject& sphere, const Ray& ray, std::optional<SurfaceHit>& nearest) {
  const Vector3d to_center = sphere.center - ray.origin;
  const double a = ray.direction.squaredNorm(), middle = to_center.dot(ray.direction);
  // The distance of the centre from the ray rather than b^2 - 4ac: no cancellation far away.
  const double off2 = (to_center - middle / a * ray.direction).squaredNorm();
  const double half2 = sphere.radius_mm * sphere.radius_mm - off2;
  if (half2 < 0) return;
  const double s = (middle - std::sqrt(half2 * a)) / a;
  if (s <= 0) return;
  keep_nearer(nearest, {s, (ray.at(s) - sphere.center) / sphere.radius_mm, sphere.material});
}

void meet_ground(const GroundObject& ground, const Ray& ray, std::optional<SurfaceHit>& nearest) {
  const double s = (ground.height_mm - ray.origin.z()) / ray.direction.z();
  if (!(s > 0) || !std::isfinite(s)) return;
  keep_nearer(nearest, {s, Vector3d(0, 0, ray.direction.z() < 0 ? 1 : -1), ground.material});
}

}  // namespace

Extrusion make_extrusion(const Rigid3& world_from_solid, const Outline& outline, double length_mm,
                         const Material& material) {
  Extrusion out{world_from_solid, bounded(outline), length_mm, material, {}};
  const std::size_t count = outline.segments.size();
  const auto size = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
  for (std::size_t first = 0; first < count; first += size) {
    const auto begin = outline.segments.begin() + static_cast<std::ptrdiff_t>(first);
    out.runs.push_back(
        bounded({{begin, begin + static_cast<std::ptrdiff_t>(std::min(size, count - first))}}));
  }
  return out;
}

std::optional<SurfaceHit> first_hit(const World& world, const Ray& ray) {
  std::optional<SurfaceHit> nearest;
  for (const BoardSurface& board : world.boards) meet_board(board, ray, nearest);
  for (const Extrusion& solid : world.extrusions) meet_extrusion(solid, ray, nearest);
  for (const Revolution& solid : world.revolutions)
    if (const auto hit = first_hit(solid, ray.origin, ray.direction))
      keep_nearer(nearest, {hit->s, hit->normal, solid.material});
  for (const SphereObject& sphere : world.spheres) meet_sphere(sphere, ray, nearest);
  if (world.ground) meet_ground(*world.ground, ray, nearest);
  return nearest;
}

bool blocked(const World& world, const Vector3d& from, const Vector3d& to) {
  const std::optional<SurfaceHit> hit = first_hit(world, {from, to - from});
  return hit && hit->s < 1 - kTouching;
}

}  // namespace lightstripe
