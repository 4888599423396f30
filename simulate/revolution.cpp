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

/// A ray seen from the axis: u(s) = u + s du, and the squared distance from the axis A s^2 + 2 B s + C, least
/// at s = middle.
struct AxialRay {
  double u, du, A, B, C;
  double per_u = 1 / du;  ///< infinite: u stays
  double middle = A > 0 ? -B / A : 0;

  double squared_radius(double s) const { return (A * s + 2 * B) * s + C; }
};

constexpr double kNever = std::numeric_limits<double>::infinity();

/// From where on the ray, before `limit`, may be within the bounds; kNever if it never is.
double entry(const AxialRay& ray, const Revolution::Bounds& bounds, double limit) {
  double from = 0, to = limit;
  if (ray.du != 0) {
    const double a = (bounds.u0 - ray.u) * ray.per_u, b = (bounds.u1 - ray.u) * ray.per_u;
    from = std::max(from, std::min(a, b)), to = std::min(to, std::max(a, b));
  } else if (ray.u < bounds.u0 || ray.u > bounds.u1) {
    return kNever;
  }
  if (!(from <= to)) return kNever;
  const double at_from = ray.squared_radius(from), outer = bounds.r1 * bounds.r1;
  if (at_from < bounds.r0 * bounds.r0 && ray.squared_radius(to) < bounds.r0 * bounds.r0) return kNever;
  if (at_from <= outer) return from;
  if (ray.squared_radius(std::clamp(ray.middle, from, to)) > outer) return kNever;
  const double half2 = ray.middle * ray.middle - (ray.C - outer) / ray.A;
  from = std::max(from, ray.middle - std::sqrt(std::max(0.0, half2)));
  return from <= to ? from : kNever;
}

struct PieceHit {
  double s = kNever;
  Vector2d normal = Vector2d::Zero();
};

/// The cone n.(u, r) = n.from, squared: (n_r r)^2 = (k - n_u u)^2 is a quadratic in s.
void meet_piece(const AxialRay& ray, const Revolution::Piece& piece, PieceHit& nearest) {
  constexpr double kBeyondMm = 1e-7;  // so that no ray slips through between two pieces
  const Vector2d& n = piece.across;
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
    const double t = (met - piece.from.position).dot(piece.along);
    if (t < -kBeyondMm || t > piece.length_mm + kBeyondMm) continue;
    if (std::abs((met - piece.from.position).dot(n)) > 1e-4) continue;  // on the mirror image, r < 0
    nearest = {
        s, (piece.from.normal + t / piece.length_mm * (piece.to.normal - piece.from.normal)).normalized()};
  }
}

/// The nearer child first: what it holds hides most of the other.
void meet_tree(const AxialRay& ray, const Revolution& solid, PieceHit& nearest) {
  struct Open {
    std::size_t node;
    double entry;
  };
  std::array<Open, 64> open;
  open[0] = {0, entry(ray, solid.tree[0], kNever)};
  for (std::size_t depth = open[0].entry < kNever ? 1 : 0; depth > 0;) {
    const Open here = open[--depth];
    if (here.entry > nearest.s) continue;
    if (here.node + 1 < solid.num_leaves) {
      Open near{2 * here.node + 1, entry(ray, solid.tree[2 * here.node + 1], nearest.s)};
      Open far{2 * here.node + 2, entry(ray, solid.tree[2 * here.node + 2], nearest.s)};
      if (far.entry < near.entry) std::swap(near, far);
      if (far.entry < kNever) open[depth++] = far;
      if (near.entry < kNever) open[depth++] = near;
      continue;
    }
    const std::size_t first = (here.node + 1 - solid.num_leaves) * Revolution::kLeafPieces;
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
    for (int i = 0; i < parts; ++i) {
      const SectionNode from = node(i), to = node(i + 1);
      const double apart = (to.position - from.position).norm();
      const Vector2d along = (to.position - from.position) / apart;
      solid.pieces.push_back({from, to, along, {along.y(), -along.x()}, apart});
    }
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
