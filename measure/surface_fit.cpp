// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/surface_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/robust.h"
#include "measure/robust_line.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kScanFloorMm = 0.002;  // robust scale: below what any scan scatters by

Vector3d registration_jacobian(const SurfaceFit& fit) {
  const Vector2d &p = fit.place, &w = fit.response;
  return {p.x() * w.y() - p.y() * w.x(), w.x(), w.y()};
}

/// Why the samples do not cover the probe; empty if they do.
std::string hole_in(std::vector<Sample1> samples, const SurfaceProbe& probe) {
  constexpr std::size_t kFewest = 6;
  if (samples.size() < kFewest) return samples.empty() ? "not seen" : "too few points";
  std::sort(samples.begin(), samples.end(), [](const Sample1& a, const Sample1& b) { return a.t < b.t; });
  if (!probe.carried && (samples.front().t > 0 || samples.back().t < 0)) return "seen on one side only";
  const double widest = (probe.to_mm - probe.from_mm) / 2;
  double last = probe.from_mm;
  for (const Sample1& s : samples) {
    if (s.t - last > widest) return "hole in the section";
    last = s.t;
  }
  return probe.to_mm - last > widest ? "hole in the section" : "";
}

/// The best quarter of the points' own predicted errors in the probe, mm; 0: not known.
double predicted_error(const PlacedSection& placed, const SurfaceProbe& probe) {
  const Vector2d left(-probe.outwards.y(), probe.outwards.x());
  std::vector<double> sigmas;
  for (std::size_t i = 0; i < placed.points.size(); ++i) {
    const Vector2d arm = placed.points[i] - probe.origin;
    const double across = arm.dot(left);
    if (across >= probe.from_mm && across <= probe.to_mm &&
        std::abs(arm.dot(probe.outwards)) <= probe.reach_mm)
      sigmas.push_back(placed.section[i].sigma_mm);
  }
  return usual_prediction(std::move(sigmas));
}

}  // namespace

double usual_prediction(std::vector<double> sigmas_mm) {
  return sigmas_mm.empty() ? 0.0 : value_at_rank(sigmas_mm, sigmas_mm.size() / 4);
}

ErrorAlong as_predicted_here(const Registration& registration, double predicted_mm) {
  constexpr double kWorst = 2;
  ErrorAlong error = registration.error;
  if (!(predicted_mm > 0 && registration.predicted_mm > 0)) return error;
  const double scale = std::min(predicted_mm / registration.predicted_mm, kWorst);
  error.own_mm *= scale, error.shared_mm *= scale;
  return error;
}

PlacedSection place(const Section& section, const ReferenceShape& reference,
                    const Registration& registration) {
  PlacedSection out{section, reference, registration, {}};
  out.points.reserve(section.size());
  for (const SectionPoint& point : section)
    out.points.push_back(registration.reference_from_section * point.position);
  return out;
}

SurfaceFit fit_surface(const PlacedSection& placed, const SurfaceProbe& probe) {
  constexpr double kDerivativeMm = 0.05, kMostWearMm = 20;
  SurfaceFit out;
  const Vector2d left(-probe.outwards.y(), probe.outwards.x());
  std::vector<Sample1> differences;
  std::vector<PlaceOnStripe> places;
  for (std::size_t i = 0; i < placed.points.size(); ++i) {
    const Vector2d& p = placed.points[i];
    const Vector2d from_origin = p - probe.origin;
    const double across = from_origin.dot(left), along = from_origin.dot(probe.outwards);
    if (across < probe.from_mm || across > probe.to_mm || std::abs(along) > probe.reach_mm) continue;
    const auto surface = placed.reference.surface_along(probe.origin, probe.outwards, across);
    if (!surface || std::abs(*surface - along) >= kMostWearMm) continue;
    differences.push_back({across, *surface - along, placed.section[i].weight});
    places.push_back({across, placed.section[i].chain});
  }
  out.reason = hole_in(differences, probe);
  const auto here = placed.reference.surface_along(probe.origin, probe.outwards, 0);
  const auto after = placed.reference.surface_along(probe.origin, probe.outwards, kDerivativeMm);
  const auto before = placed.reference.surface_along(probe.origin, probe.outwards, -kDerivativeMm);
  if (!here || !after || !before) out.reason = "the reference has no surface there";
  if (!out.known()) return out;
  const auto fit = fit_polynomial(differences, probe.degree, kScanFloorMm);
  if (!fit) {
    out.reason = "points do not agree";
    return out;
  }
  out.wear_mm = fit->value;
  out.along_mm = *here - fit->value;
  out.slope = (*after - *before) / (2 * kDerivativeMm) - fit->slope;
  out.rms_mm = fit->rms;
  out.num_points = fit->num_samples;
  // Across a slope the errors, which are normal to the surface, and the places along it are longer.
  const double steep = std::hypot(1, out.slope);
  for (PlaceOnStripe& place : places) place.along_mm *= steep;
  const double predicted = predicted_error(placed, probe);
  const ErrorAlong error = where_points_scatter(as_predicted_here(placed.registration, predicted),
                                                fit->rms / steep, fit->num_samples);
  out.local_sigma_mm = steep * sigma_of_sum(error, places, influences(differences, *fit, probe.degree, 0));
  // Glare over all of the probe is an error that its points share.
  if (predicted > std::hypot(error.own_mm, error.shared_mm))
    out.local_sigma_mm = std::max(out.local_sigma_mm, predicted);
  out.place = probe.origin + out.along_mm * probe.outwards;
  out.response = probe.outwards - out.slope * left;
  return out;
}

double sigma_of(const SurfaceFit& fit, const Registration& registration) {
  const Vector3d J = registration_jacobian(fit);
  return std::sqrt(fit.local_sigma_mm * fit.local_sigma_mm +
                   std::max(0.0, J.dot(registration.covariance * J)));
}

double sigma_of_sum(const SurfaceFit& a, const SurfaceFit& b, const Registration& registration) {
  const Vector3d J = registration_jacobian(a) + registration_jacobian(b);
  return std::sqrt(a.local_sigma_mm * a.local_sigma_mm + b.local_sigma_mm * b.local_sigma_mm +
                   std::max(0.0, J.dot(registration.covariance * J)));
}

}  // namespace lightstripe
