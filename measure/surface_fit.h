// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The measured surface at one place, seen along one direction: how far it lies inside the reference there.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "measure/register_section.h"

namespace lightstripe {

/// A section laid on its reference.
struct PlacedSection {
  const Section& section;
  const ReferenceShape& reference;
  const Registration& registration;
  std::vector<Eigen::Vector2d> points;  ///< of the section, on the reference
};
PlacedSection place(const Section& section, const ReferenceShape& reference,
                    const Registration& registration);

/// Of the predicted errors of points at one place, mm: that of the better ones; 0 for none.
double usual_prediction(std::vector<double> sigmas_mm);

/// The error of points whose own predicted one is not that of the points that the registration rests on: a
/// face that a sensor looks straight at is better known than the web that it sees at a glance, a bend in
/// grain less well than what is straight.
ErrorAlong as_predicted_here(const Registration& registration, double predicted_mm);

/// Where to look: from `origin` along `outwards` (unit), at the points that lie between `from_mm` and `to_mm`
/// across it (+ to its left) and within `reach_mm` along it.
struct SurfaceProbe {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();
  Eigen::Vector2d outwards = Eigen::Vector2d::UnitY();
  double from_mm = -1.5, to_mm = 1.5;
  double reach_mm = 16;
  int degree = 2;        ///< of the polynomial of the difference to the reference
  bool carried = false;  ///< the points lie aside; the polynomial is carried to the origin
};

struct SurfaceFit {
  std::string reason = "no points";  ///< empty: known
  double wear_mm = 0;                ///< reference minus measured, along `outwards`
  double along_mm = 0;               ///< of the measured surface, from the probe's origin
  double slope = 0;                  ///< d along / d across (to the left) of the measured surface
  double local_sigma_mm = 0;         ///< of along_mm: scatter and stretch error
  double rms_mm = 0;
  int num_points = 0;
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  Eigen::Vector2d response = Eigen::Vector2d::Zero();  ///< d along / d displacement of the section

  bool known() const { return reason.empty(); }
};

/// The difference to the reference, fitted robustly by a polynomial across the probe: where the section is
/// worn evenly it is smooth even where the outline bends. Unknown where there are fewer than six points, or
/// none on one side of the origin, or a hole wider than half of the probe.
SurfaceFit fit_surface(const PlacedSection& placed, const SurfaceProbe& probe);

/// 1-sigma of a surface's place along the probe: points and registration.
double sigma_of(const SurfaceFit& fit, const Registration& registration);
/// The same of the sum of two surfaces' places, whose registration is common: a width, seen from both sides.
double sigma_of_sum(const SurfaceFit& a, const SurfaceFit& b, const Registration& registration);

}  // namespace lightstripe
