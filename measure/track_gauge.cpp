// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/track_gauge.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "measure/rail_head.h"

namespace lightstripe {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

Matrix2d turn_of(const PlacedSection& placed) {
  return Eigen::Rotation2Dd(placed.registration.reference_from_section.move.angle_rad).toRotationMatrix();
}

Vector2d section_from_reference(const PlacedSection& placed, const Vector2d& p) {
  return turn_of(placed).transpose() * (p - placed.registration.reference_from_section.move.translation);
}

/// A rail's highest point over the running plane.
struct Crest {
  std::string reason;  ///< empty: known
  Vector2d on_reference = Vector2d::Zero(), in_section = Vector2d::Zero();
};

Crest find_crest(const PlacedSection& placed, const Vector2d& up_in_section) {
  const Vector2d up = turn_of(placed) * up_in_section;
  const HeadTop top = find_head_top(placed, up);
  if (!top.reason.empty()) return {top.reason, {}, {}};
  const Vector2d crest = top.u * Vector2d(up.y(), -up.x()) + top.v * up;
  return {"", crest, section_from_reference(placed, crest)};
}

/// A gauge face where the gauge is taken, section coordinates.
struct GaugePoint {
  std::string reason;  ///< empty: known
  Vector2d place = Vector2d::Zero();
  double sigma_mm = 0;
};

/// How far the second farthest point between the crest and the gauge's depth stands out along `inwards`.
std::optional<double> farthest_out(const PlacedSection& placed, const Vector2d& origin,
                                   const Vector2d& inwards, const Vector2d& up, double depth_mm) {
  constexpr double kTrusted = 0.02;
  double farthest = -1e300, second = -1e300;
  for (std::size_t i = 0; i < placed.points.size(); ++i) {
    const Vector2d arm = placed.points[i] - origin;
    if (placed.section[i].weight <= kTrusted || arm.dot(up) < 0 || arm.dot(up) > depth_mm) continue;
    const double out = arm.dot(inwards);
    if (out > farthest)
      second = farthest, farthest = out;
    else
      second = std::max(second, out);
  }
  if (second < -1e299) return std::nullopt;
  return second;
}

GaugePoint find_gauge_point(const PlacedSection& placed, const Crest& crest,
                            const Vector2d& inwards_in_section, const Vector2d& up_in_section,
                            const RailOptions& options) {
  const Vector2d inwards = turn_of(placed) * inwards_in_section, up = turn_of(placed) * up_in_section;
  const Vector2d origin = crest.on_reference - options.gauge_point_mm * up;
  const SurfaceFit face = fit_head_face(placed, origin, inwards);
  const auto lip = farthest_out(placed, origin, inwards, up, options.gauge_point_mm);
  double out = face.along_mm, sigma = face.local_sigma_mm;
  if (lip && (!face.known() || *lip > face.along_mm + options.lip_mm)) {
    // Without a face the lip may be the corner's end: only one that overhangs the new rail's face is one.
    const auto unworn = placed.reference.surface_along(origin, inwards, 0);
    if (!face.known() && !(unworn && *lip > *unworn + options.lip_mm)) return {face.reason, {}, 0};
    out = *lip, sigma = placed.registration.rms_mm;
  } else if (!face.known()) {
    return {face.reason, {}, 0};
  }
  return {"", section_from_reference(placed, origin + out * inwards), sigma};
}

}  // namespace

std::optional<double> place_between_rails(const std::vector<Profile>& profiles) {
  constexpr double kNarrowestMm = 300;
  std::vector<double> places;
  for (const Profile& profile : profiles)
    for (const ProfilePoint& point : profile.points) places.push_back(point.u);
  std::sort(places.begin(), places.end());
  double widest = kNarrowestMm;
  std::optional<double> between;
  for (std::size_t i = 1; i < places.size(); ++i)
    if (places[i] - places[i - 1] > widest)
      widest = places[i] - places[i - 1], between = (places[i] + places[i - 1]) / 2;
  return between;
}

RailPair split_rails(const Profile& profile, double between_u) {
  RailPair pair{profile, profile};
  std::erase_if(pair.left.points, [&](const ProfilePoint& p) { return p.u < between_u; });
  std::erase_if(pair.right.points, [&](const ProfilePoint& p) { return p.u >= between_u; });
  return pair;
}

TrackPlane find_track_plane(const PlacedSection& left, const PlacedSection& right, const RailOptions& options,
                            std::optional<double> rig_sigma_mm) {
  constexpr int kRounds = 3;  // the plane turns the crests, they the plane: by 1e-3 of a round before
  TrackPlane track;
  const auto unknown = [&](std::string reason) {
    track.gauge = Estimate::unknown(std::move(reason));
    return track;
  };
  Vector2d& across = track.across;
  Crest left_crest, right_crest;
  for (int round = 0; round < kRounds; ++round) {
    const Vector2d up(-across.y(), across.x());
    left_crest = find_crest(left, up), right_crest = find_crest(right, up);
    if (!left_crest.reason.empty()) return unknown("left rail: " + left_crest.reason);
    if (!right_crest.reason.empty()) return unknown("right rail: " + right_crest.reason);
    across = (left_crest.in_section - right_crest.in_section).normalized();
  }
  const Vector2d up(-across.y(), across.x());
  const GaugePoint from = find_gauge_point(right, right_crest, across, up, options);
  const GaugePoint to = find_gauge_point(left, left_crest, -across, up, options);
  if (!to.reason.empty()) return unknown("left gauge face " + to.reason);
  if (!from.reason.empty()) return unknown("right gauge face " + from.reason);
  track.crest = {left_crest.in_section, right_crest.in_section};
  track.gauge_point = {to.place, from.place};
  track.gauge = {(to.place - from.place).dot(across), std::nullopt, ""};
  if (rig_sigma_mm)
    track.gauge.sigma = std::hypot(std::hypot(from.sigma_mm, to.sigma_mm), std::sqrt(2.0) * *rig_sigma_mm);
  return track;
}

Estimate track_gauge(const PlacedSection& left, const PlacedSection& right, const RailOptions& options,
                     std::optional<double> rig_sigma_mm) {
  return find_track_plane(left, right, options, rig_sigma_mm).gauge;
}

}  // namespace lightstripe
