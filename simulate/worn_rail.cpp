// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "simulate/worn_rail.h"

#include <cmath>

#include "core/error.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

enum HeadSegment : std::size_t { kCrown, kShoulder, kCorner, kFace, kLowerCorner, kFishing, kHeadSegments };

/// The right half from the top down.
Outline half_of(const Outline& closed) {
  Outline half = reversed(closed);
  half.segments.resize(half.segments.size() / 2);
  const auto& s = half.segments;
  const bool head = s.size() >= kHeadSegments && std::abs(s[kCrown].from.x()) < kOutlineJointMm &&
                    !s[kCrown].straight() && !s[kShoulder].straight() && !s[kCorner].straight() &&
                    s[kFace].straight();
  if (!head)
    throw Error("rail.profile", "has no head of crown, shoulder, corner and face", "leave wear at 0");
  return half;
}

[[noreturn]] void too_much(const char* what) {
  throw Error("rail: wear", std::string("leaves nothing of the head's ") + what, "give less wear");
}

/// Centre of the circle of radius r inside a larger circle that it touches, and right of a line (seen along
/// `along`) that it touches; the upper of the two.
Vector2d fillet_center(const OutlineSegment& shoulder, const Vector2d& on_line, const Vector2d& along,
                       double r) {
  const Vector2d inwards(along.y(), -along.x());
  const Vector2d start = on_line + r * inwards - shoulder.center;
  const double b = start.dot(along), inner = shoulder.radius - r;
  const double discriminant = b * b - start.squaredNorm() + inner * inner;
  if (discriminant < 0) too_much("shoulder");
  return shoulder.center + start + (-b - std::sqrt(discriminant)) * along;
}

/// Ends the face where it meets what the wear has left of the head's underside, and drops what it cut away.
void join_face_below(Outline& half, const Vector2d& face_top, const Vector2d& down) {
  auto& s = half.segments;
  const Outline underside{{s[kLowerCorner], s[kFishing]}};
  const std::optional<OutlineHit> hit = first_hit(underside, face_top, down, 0);
  // A face moved by less than the table's rounding may miss the corner that it is tangent to.
  if (!hit && (s[kFace].to - s[kLowerCorner].from).norm() < kOutlineJointMm) {
    s[kFace].to = s[kLowerCorner].from;
    return;
  }
  if (!hit) too_much("underside");
  const Vector2d edge = face_top + hit->s * down;
  s[kFace].to = edge;
  s[kLowerCorner + static_cast<std::size_t>(hit->segment)].from = edge;
  if (hit->segment == 1) s.erase(s.begin() + kLowerCorner);
}

Outline worn_half(const Outline& nominal_half, double vertical_mm, double side_mm) {
  Outline half = nominal_half;
  auto& s = half.segments;
  const Vector2d down(0, -vertical_mm), in(-side_mm, 0);
  for (const std::size_t i : {kCrown, kShoulder}) {
    s[i].from += down;
    s[i].to += down;
    s[i].center += down;
  }
  s[kFace].from += in;
  s[kFace].to += in;
  const Vector2d along = (s[kFace].to - s[kFace].from).normalized();
  const double r = s[kCorner].radius;
  s[kCorner].center = fillet_center(s[kShoulder], s[kFace].from, along, r);
  const Vector2d out = (s[kCorner].center - s[kShoulder].center).normalized();
  s[kShoulder].to = s[kCorner].from = s[kShoulder].center + s[kShoulder].radius * out;
  s[kCorner].to = s[kFace].from = s[kCorner].center - r * Vector2d(along.y(), -along.x());
  if (s[kShoulder].to.x() <= s[kShoulder].from.x()) too_much("shoulder");
  if ((s[kFace].to - s[kFace].from).dot(along) <= 0) too_much("face");
  if (side_mm > 0) join_face_below(half, s[kFace].from, along);
  return half;
}

}  // namespace

Outline worn_rail(const Outline& nominal, double vertical_mm, double side_mm) {
  if (vertical_mm == 0 && side_mm == 0) return nominal;
  const Outline half = half_of(nominal);
  const Outline gauge = worn_half(half, vertical_mm, side_mm), field = worn_half(half, vertical_mm, 0);
  // Counterclockwise from the top: the field half down, then the gauge half up.
  Outline out = mirrored(field);
  out.segments.resize(field.segments.size());
  const Outline back = reversed(gauge);
  out.segments.insert(out.segments.end(), back.segments.begin(), back.segments.end());
  return out;
}

}  // namespace lightstripe
