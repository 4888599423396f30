// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "simulate/revolution.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/error.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// A ray seen from the axis: u(s) = u + s du, and the squared distance from the axis A s^2 + 2 B s + C.
struct AxialRay {
  double u, du, A, B, C;

  double squared_radius(double s) const { return (A * s + 2 * B) * s + C; }
};

struct Interval {
  double from, to;
};

/// Where the ray's u lies between two values, within `limit`; from > to where it never does.
Interval within(const AxialRay& ray, double u0, double u1, const Interval& limit) {
  if (ray.du == 0) return ray.u >= u0 && ray.u <= u1 ? limit : Interval{1, 0};
  const double a = (u0 - ray.u) / ray.du, b = (u1 - ray.u) / ray.du;
  return {std::max(limit.from, std::min(a, b)), std::min(limit.to, std::max(a, b))};
}

bool may_meet(const AxialRay& ray, const Revolution::Bounds& bounds, const Interval& limit) {
  const Interval in = within(ray, bounds.u0, bounds.u1, limit);
  if (in.from > in.to) return false;
  const double at_ends = std::max(ray.squared_radius(in.from), ray.squared_radius(in.to));
  if (at_ends < bounds.r0 * bounds.r0) return false;
  const double nearest = ray.A > 0 ? std::clamp(-ray.B / ray.A, in.from, in.to) : in.from;
  return ray.squared_radius(nearest) <= bounds.r1 * bounds.r1;
}

struct PieceHit {
  double s = std::numeric_limits<double>::infinity();
  Vector2d normal = Vector2d::Zero();
};

/// The cone n.(u, r) = n.from, squared: (n_r r)^2 = (k - n_u u)^2 is a quadratic in s.
void meet_piece(const AxialRay& ray, const Revolution::Piece& piece, PieceHit& nearest) {
  constexpr double kBeyondMm = 1e-7;  // so that no ray slips through between two pieces
  const Vector2d along = piece.to.position - piece.from.position;
  const double length = along.norm();
  const Vector2d n(along.y() / length, -along.x() / length);
  const double k0 = n.dot(piece.from.position) - n.x() * ray.u, k1 = -n.x() * ray.du;  // n_r r = k0 + k1 s
  const double nn = n.y() * n.y();
  const double a = nn * ray.A - k1 * k1, b = nn * ray.B - k0 * k1, c = nn * ray.C - k0 * k0;
  const double discriminant = b * b - a * c;
  if (discriminant < -1e-12 * b * b) return;
  // Of the two forms of each root the one without cancellation. A flat face (n_r = 0) has a double root.
  const double q = -(b + std::copysign(std::sqrt(std::max(0.0, discriminant)), b));
  for (const double s : std::array<double, 2>{q / a, c / q}) {
    if (!(s > 0) || !(s < nearest.s)) continue;
    const Vector2d met(ray.u + s * ray.du, std::sqrt(std::max(0.0, ray.squared_radius(s))));
    const double t = (met - piece.from.position).dot(along) / length;
    if (t < -kBeyondMm || t > length + kBeyondMm) continue;
    if (std::abs((met - piece.from.position).dot(n)) > 1e-4) continue;  // on the mirror image, r < 0
    nearest = {s, (piece.from.normal + t / length * (piece.to.normal - piece.from.normal)).normalized()};
  }
}

void meet_tree(const AxialRay& ray, const Revolution& solid, PieceHit& nearest) {
  std::array<std::size_t, 64> open{0};
  for (std::size_t depth = 1; depth > 0;) {
    const std::size_t node = open[--depth];
    if (!may_meet(ray, solid.tree[node], {0, nearest.s})) continue;
    if (node + 1 < solid.num_leaves) {
      open[depth++] = 2 * node + 1;
      open[depth++] = 2 * node + 2;
      continue;
    }
    const std::size_t first = (node + 1 - solid.num_leaves) * Revolution::kLeafPieces;
    const std::size_t end = std::min(first + Revolution::kLeafPieces, solid.pieces.size());
    for (std::size_t i = first; i < end; ++i) meet_piece(ray, solid.pieces[i], nearest);
  }
}

/// Bounds of the leaf's pieces; of a leaf without pieces ones that nothing meets.
Revolution::Bounds bounds_of(const Revolution& solid, std::size_t leaf) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Revolution::Bounds bounds{kFar, -kFar, kFar, 0};
  const std::size_t first = leaf * Revolution::kLeafPieces;
  for (std::size_t i = first; i < std::min(first + Revolution::kLeafPieces, solid.pieces.size()); ++i)
    for (const Vector2d& p : {solid.pieces[i].from.position, solid.pieces[i].to.position})
      bounds = {std::min(bounds.u0, p.x() - 1e-6), std::max(bounds.u1, p.x() + 1e-6),
                std::min(bounds.r0, p.y() - 1e-6), std::max(bounds.r1, p.y() + 1e-6)};
  return bounds;
}

void grow_tree(Revolution& solid) {
  const std::size_t wanted = (solid.pieces.size() + Revolution::kLeafPieces - 1) / Revolution::kLeafPieces;
  solid.num_leaves = 1;
  while (solid.num_leaves < wanted) solid.num_leaves *= 2;
  solid.tree.resize(2 * solid.num_leaves - 1);
  for (std::size_t i = solid.tree.size(); i-- > 0;) {
    if (i + 1 >= solid.num_leaves) {
      solid.tree[i] = bounds_of(solid, i + 1 - solid.num_leaves);
      continue;
    }
    const Revolution::Bounds &a = solid.tree[2 * i + 1], &b = solid.tree[2 * i + 2];
    solid.tree[i] = {std::min(a.u0, b.u0), std::max(a.u1, b.u1), std::min(a.r0, b.r0), std::max(a.r1, b.r1)};
  }
}

}  // namespace

Revolution make_revolution(const Rigid3& world_from_solid, const Outline& section, double datum_radius_mm,
                           const Material& material, double spacing_mm) {
  Revolution solid{world_from_solid, material, {}, {}, 0};
  const Vector2d lift(0, datum_radius_mm);
  for (const OutlineSegment& segment : section.segments) {
    const int parts =
        segment.straight() ? 1 : std::max(1, static_cast<int>(std::ceil(length(segment) / spacing_mm)));
    const auto node = [&](int i) {
      const double t = static_cast<double>(i) / parts;
      return SectionNode{point_at(segment, t) + lift, normal_at(segment, t)};
    };
    for (int i = 0; i < parts; ++i) solid.pieces.push_back({node(i), node(i + 1)});
  }
  for (const auto& piece : solid.pieces)
    LIGHTSTRIPE_CHECK(piece.from.position.y() > 0, "a section of revolution lies beyond the axis");
  grow_tree(solid);
  return solid;
}

std::optional<RevolutionHit> first_hit(const Revolution& solid, const Vector3d& origin,
                                       const Vector3d& direction) {
  const Eigen::Matrix3d R = solid.world_from_solid.rotation.toRotationMatrix();
  const Vector3d o = R.transpose() * (origin - solid.world_from_solid.translation),
                 d = R.transpose() * direction;
  const Vector2d o_off = o.tail<2>(), d_off = d.tail<2>();
  const AxialRay ray{o.x(), d.x(), d_off.squaredNorm(), o_off.dot(d_off), o_off.squaredNorm()};
  PieceHit nearest;
  meet_tree(ray, solid, nearest);
  if (!std::isfinite(nearest.s)) return std::nullopt;
  const Vector2d outwards = (o_off + nearest.s * d_off).normalized();
  Vector3d normal =
      R * Vector3d(nearest.normal.x(), nearest.normal.y() * outwards.x(), nearest.normal.y() * outwards.y());
  if (normal.dot(direction) > 0) normal = -normal;
  return RevolutionHit{nearest.s, normal};
}

}  // namespace lightstripe
