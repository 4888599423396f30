// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/conicity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "measure/profile_formats.h"

namespace lightstripe {
namespace {

constexpr double kReferenceMm = 3;         // the amplitude that limits speak of
constexpr std::uint64_t kSeed = 0x636f6e;  // of the repeats

using Profiles = std::array<RollingProfile, kSides>;
using Track = std::array<WheelOnRail, kSides>;

/// The profiles as measured.
Track track_of(const Profiles& wheels, const Profiles& rails, double gauge_mm, double back_to_back_mm) {
  Track track;
  for (std::size_t s = 0; s < kSides; ++s)
    track[s] = {wheels[s].surface.table(), rails[s].surface.table(), back_to_back_mm / 2 + kTreadDatumMm,
                gauge_mm / 2 - rails[s].gauge_face_mm};
  return track;
}

RadiusDifference difference_of(const WheelsetWalk& walk, double radius_difference_mm) {
  RadiusDifference out;
  if (!walk.usable()) return out;
  out.first_mm = walk.places.front().shift_mm;
  if (walk.places.size() > 1)
    out.step_mm = (walk.places.back().shift_mm - out.first_mm) / static_cast<double>(walk.places.size() - 1);
  for (const WheelsetPlace& place : walk.places)
    out.delta_r_mm.push_back(place.radius_difference_mm() + radius_difference_mm);
  return out;
}

double radius_difference(const Profiles& wheels, const ConicityOptions& options) {
  return wheels[1].radius_mm - wheels[0].radius_mm + options.radius_difference_mm;
}

std::vector<double> amplitudes(const ConicityOptions& options) {
  constexpr double kStepMm = 0.1;
  std::vector<double> out;
  for (int i = 0; options.from_mm + kStepMm * i <= options.to_mm + 1e-9; ++i)
    out.push_back(options.from_mm + kStepMm * i);
  return out;
}

std::vector<std::optional<double>> conicities(const RadiusDifference& difference,
                                              const std::vector<double>& at) {
  const KlingelWave wave(difference);
  std::vector<std::optional<double>> out;
  for (const double amplitude : at) out.push_back(wave.tan_gamma_e(amplitude));
  return out;
}

bool has_noise(const Profiles& wheels, const Profiles& rails, const ConicityOptions& options) {
  double sum = options.gauge_sigma_mm + options.back_to_back_sigma_mm;
  for (const Profiles* profiles : {&wheels, &rails})
    for (const RollingProfile& one : *profiles) sum += one.surface.sigma_mm();
  return sum > 0;
}

/// Root mean square of the repeats about the result, at each amplitude: how they scatter, and how far their
/// mean lies off, which is what smoothing does to bends. Nothing where fewer than three in four repeats reach
/// it.
std::vector<std::optional<double>> spread_of_repeats(const Profiles& wheels, const Profiles& rails,
                                                     const ConicityOptions& options,
                                                     const std::vector<double>& at,
                                                     const std::vector<std::optional<double>>& values) {
  constexpr double kCoarseMm = 0.25;  // search of the nearest place: the smoothed noise has no shorter waves
  std::vector<double> squares(at.size(), 0.0);
  std::vector<int> count(at.size(), 0);
  // One file on both sides is one measurement and its mirror image: both err alike.
  const bool same_wheel = wheels[0].name == wheels[1].name, same_rail = rails[0].name == rails[1].name;
  Random random(kSeed);
  for (int draw = 0; draw < options.draws; ++draw) {
    Track track = track_of(wheels, rails, options.gauge_mm + options.gauge_sigma_mm * random.gaussian(),
                           options.back_to_back_mm + options.back_to_back_sigma_mm * random.gaussian());
    for (std::size_t s = 0; s < kSides; ++s) {
      track[s].wheel = wheels[s].surface.redrawn(random);
      track[s].rail = rails[s].surface.redrawn(random);
    }
    if (same_wheel) track[1].wheel = track[0].wheel;
    if (same_rail) track[1].rail = track[0].rail;
    ContactOptions contact;
    contact.search_mm = kCoarseMm;
    contact.farthest_mm = at.back() + 1;
    const auto drawn =
        conicities(difference_of(walk_wheelset(track, contact), radius_difference(wheels, options)), at);
    for (std::size_t i = 0; i < at.size(); ++i)
      if (drawn[i] && values[i]) squares[i] += std::pow(*drawn[i] - *values[i], 2), ++count[i];
  }
  std::vector<std::optional<double>> out(at.size());
  for (std::size_t i = 0; i < at.size(); ++i)
    if (count[i] > 1 && 4 * count[i] >= 3 * options.draws) out[i] = std::sqrt(squares[i] / count[i]);
  return out;
}

std::optional<double> value_at(const Conicity& conicity, double amplitude) {
  for (const ConicityRow& row : conicity.rows)
    if (std::abs(row.y_mm - amplitude) < 1e-6) return row.tan_gamma_e;
  return std::nullopt;
}

void judge(const ConicityOptions& options, Conicity& out) {
  out.at_3_mm = value_at(out, kReferenceMm);
  for (const ConicityRow& row : out.rows)
    if (std::abs(row.y_mm - kReferenceMm) < 1e-6) out.at_3_mm_sigma = row.sigma;
  const auto low = value_at(out, kReferenceMm - 1), high = value_at(out, kReferenceMm + 1);
  if (low && high) out.nonlinearity_per_mm = (*high - *low) / 2;
  if (!options.max_conicity) return;
  out.verdict = !out.at_3_mm ? "unknown" : *out.at_3_mm > *options.max_conicity ? "fail" : "pass";
}

std::string why_it_ends(const WheelsetWalk& walk) {
  for (const ContactEnd end : {walk.left_end, walk.right_end})
    if (end == ContactEnd::kOutside) return "the contact leaves the measured part of a profile";
  for (const ContactEnd end : {walk.left_end, walk.right_end})
    if (end == ContactEnd::kFlange) return "the flange touches";
  return "";
}

}  // namespace

Conicity equivalent_conicity(const Profiles& wheels, const Profiles& rails, const ConicityOptions& options) {
  Conicity out;
  ContactOptions contact;
  contact.farthest_mm = options.to_mm + 2;
  out.walk = walk_wheelset(track_of(wheels, rails, options.gauge_mm, options.back_to_back_mm), contact);
  if (!out.walk.usable()) {
    out.reason = "contact outside the measured part of a profile already in the middle of the track";
    return out;
  }
  const RadiusDifference difference = difference_of(out.walk, radius_difference(wheels, options));
  const double reach = std::min(-difference.first_mm, difference.last_mm());
  if (reach < options.from_mm) {
    out.reason = fmt::format("contact known up to a shift of {:.1f} mm only: {}", std::max(0.0, reach),
                             why_it_ends(out.walk));
    return out;
  }
  out.jumps = find_jumps(out.walk);
  const std::vector<double> at = amplitudes(options);
  const auto values = conicities(difference, at);
  const auto sigmas = has_noise(wheels, rails, options) && options.draws > 1
                          ? spread_of_repeats(wheels, rails, options, at, values)
                          : std::vector<std::optional<double>>(at.size(), 0.0);
  for (std::size_t i = 0; i < at.size() && at[i] <= difference.last_mm() + 1e-9; ++i)
    out.rows.push_back({at[i], difference.at(at[i]), values[i], values[i] ? sigmas[i] : std::nullopt});
  if (out.rows.empty() || out.rows.back().y_mm < options.to_mm - 1e-6) out.note = why_it_ends(out.walk);
  out.reason.clear();
  judge(options, out);
  if (!out.at_3_mm && options.from_mm <= kReferenceMm && options.to_mm >= kReferenceMm)
    out.reason = "no wave of 3 mm: " +
                 (why_it_ends(out.walk).empty() ? "the radii are nowhere equal" : why_it_ends(out.walk));
  return out;
}

std::optional<double> gauge_face_of(const std::vector<Eigen::Vector2d>& rail, double top_mm,
                                    double depth_mm) {
  constexpr double kShortMm = 0.02;  // a profile that ends at the very depth
  const double level = top_mm - depth_mm;
  std::optional<double> innermost;
  bool reached = false;
  for (std::size_t i = 0; i < rail.size(); ++i) {
    if (rail[i].y() >= level && rail[i].y() <= top_mm + 1)
      innermost = std::min(innermost.value_or(1e300), rail[i].x());
    reached |= rail[i].x() < 0 && rail[i].y() <= level + kShortMm;
    if (i == 0) continue;
    const Eigen::Vector2d &a = rail[i - 1], &b = rail[i];
    if ((a.y() - level) * (b.y() - level) >= 0 || std::min(a.x(), b.x()) > 0) continue;
    innermost =
        std::min(innermost.value_or(1e300), a.x() + (level - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
  }
  return reached ? innermost : std::nullopt;
}

}  // namespace lightstripe
