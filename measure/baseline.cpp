// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/baseline.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "core/error.h"
#include "core/robust.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

constexpr double kNodeMm = 0.5;

/// A section's distances to the nominal outline, sorted by where their feet lie along it.
std::map<double, double> distances_along(const Section& section, const ReferenceShape& nominal,
                                         const Registration& registration) {
  constexpr double kTrusted = 0.02;
  std::map<double, double> out;
  for (const SectionPoint& point : section) {
    if (point.weight < kTrusted) continue;
    const auto foot = nominal.nearest(registration.reference_from_section * point.position);
    if (foot && !foot->beyond_end) out.emplace(nominal.arc_length(*foot), foot->signed_distance);
  }
  return out;
}

std::optional<double> median_near(const std::map<double, double>& distances, double s) {
  constexpr double kNearMm = 1;
  std::vector<double> near;
  for (auto at = distances.lower_bound(s - kNearMm); at != distances.end() && at->first < s + kNearMm; ++at)
    near.push_back(at->second);
  if (near.size() < 3) return std::nullopt;
  return median(std::move(near));
}

/// Fills what is missing in a straight way between the neighbours around a closed or open chain.
std::vector<double> without_holes(const std::vector<std::optional<double>>& values) {
  std::vector<std::size_t> known;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i]) known.push_back(i);
  std::vector<double> out(values.size(), 0.0);
  if (known.empty()) return out;
  const std::size_t n = values.size();
  for (std::size_t k = 0; k < known.size(); ++k) {
    const std::size_t from = known[k], to = k + 1 < known.size() ? known[k + 1] : known[0] + n;
    for (std::size_t i = from; i < to; ++i) {
      const double t = static_cast<double>(i - from) / static_cast<double>(to - from);
      out[i % n] = *values[from] + t * (*values[to % n] - *values[from]);
    }
  }
  return out;
}

}  // namespace

Outline outline_of_baseline(const Section& section, const ReferenceShape& nominal,
                            const Registration& registration) {
  LIGHTSTRIPE_CHECK(registration.usable(), "a baseline has to be registered");
  const std::map<double, double> distances = distances_along(section, nominal, registration);
  const std::vector<OutlineSample> nodes = sample(nominal.outline(), kNodeMm);
  std::vector<std::optional<double>> seen;
  for (const OutlineSample& node : nodes) seen.push_back(median_near(distances, node.arc_length));
  const std::vector<double> moved = without_holes(seen);
  std::vector<Vector2d> points;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    points.push_back(nodes[i].position + moved[i] * nodes[i].normal);
  Outline out;
  for (std::size_t i = 0; i + (nominal.outline().closed() ? 0 : 1) < points.size(); ++i) {
    const Vector2d& next = points[(i + 1) % points.size()];
    if ((next - points[i]).norm() > 1e-6) out.segments.push_back(line_segment(points[i], next));
  }
  return out;
}

Baseline::Baseline(const std::vector<Profile>& profiles, const ReferenceShape& nominal,
                   const SectionPrior& prior, const RegistrationOptions& options, const std::string& source) {
  std::string reason = "it has no sections";
  for (const Profile& profile : profiles) {
    const Section section = section_of(profile);
    const Registration registration = register_section(section, nominal, prior, options);
    if (registration.usable())
      places_.push_back(
          {profile.travel, ReferenceShape(nominal.name() + " baseline", nominal.kind(),
                                          outline_of_baseline(section, nominal, registration))});
    else
      reason = registration.reason;
  }
  if (places_.empty())
    throw Error(source, "cannot be a baseline: " + reason, "give sections that lie on " + nominal.name());
  std::stable_sort(places_.begin(), places_.end(),
                   [](const Place& a, const Place& b) { return a.travel < b.travel; });
  std::vector<double> steps;
  for (std::size_t i = 1; i < places_.size(); ++i) steps.push_back(places_[i].travel - places_[i - 1].travel);
  if (!steps.empty()) reach_ = 2 * median(std::move(steps));
}

const ReferenceShape* Baseline::at(double travel) const {
  const auto nearer = [&](const Place& a, const Place& b) {
    return std::abs(a.travel - travel) < std::abs(b.travel - travel);
  };
  const Place& nearest = *std::min_element(places_.begin(), places_.end(), nearer);
  if (places_.size() > 1 && std::abs(nearest.travel - travel) > reach_) return nullptr;
  return &nearest.shape;
}

}  // namespace lightstripe
