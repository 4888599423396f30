// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Equivalent conicity of a wheelset on a track, with its predicted error.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/fields.h"
#include "measure/klingel.h"
#include "measure/wheelset_contact.h"

namespace lightstripe {

/// A wheel's or a rail's rolling surface with where it counts from.
struct RollingProfile {
  std::string name;
  RunningSurface surface;
  double radius_mm = 0;  ///< wheel: its radius at the datum less the nominal one
  double gauge_face_mm =
      0;  ///< rail: y of the gauge point, gauge_point_mm below the level that it counts from
};

struct ConicityOptions {
  double gauge_mm = 1435;
  double back_to_back_mm = 1360;
  double gauge_sigma_mm = 0;  ///< 1-sigma of the gauge
  double back_to_back_sigma_mm = 0;
  double radius_difference_mm = 0;     ///< right wheel's radius less the left one's, at the datum
  double from_mm = 1, to_mm = 8;       ///< amplitudes
  int draws = 40;                      ///< of the profiles' noise; 0: no sigma
  std::optional<double> max_conicity;  ///< at 3 mm; none: no verdict
};
template <class V>
void visit_fields(V&& v, ConicityOptions& o) {
  v("gauge", o.gauge_mm, "distance of the gauge faces, mm");
  v("back_to_back", o.back_to_back_mm, "distance of the wheels' backs, mm");
  v("gauge_sigma", o.gauge_sigma_mm, "1-sigma error of the gauge, mm");
  v("back_to_back_sigma", o.back_to_back_sigma_mm, "1-sigma error of the distance of the backs, mm");
  v("radius_difference", o.radius_difference_mm,
    "radius of the right wheel less that of the left one at the tread datum, mm");
  v("from", o.from_mm, "first amplitude, mm");
  v("to", o.to_mm, "last amplitude, mm; the flange's contact may end the table before");
  v("draws", o.draws, "repeats with fresh noise for the predicted error; 0: none");
  v("max_conicity", o.max_conicity, "limit of tan gamma_e at 3 mm");
}

struct ConicityRow {
  double y_mm = 0;                    ///< amplitude, and shift to the right
  double delta_r_mm = 0;              ///< at this shift
  std::optional<double> tan_gamma_e;  ///< unknown: the wave does not come back within the known contacts
  std::optional<double> sigma;
};

struct Conicity {
  std::string reason = "not computed";  ///< empty: usable
  std::vector<ConicityRow> rows;
  WheelsetWalk walk;
  std::vector<ContactJump> jumps;
  std::optional<double> at_3_mm, at_3_mm_sigma;
  /// (tan gamma_e at 4 mm less that at 2 mm) / 2 mm: our own definition of how it depends on the amplitude.
  std::optional<double> nonlinearity_per_mm;
  std::string verdict;  ///< pass, fail, unknown; empty without a limit
  std::string note;     ///< why the table ends before options.to_mm; empty if it does not

  bool usable() const { return reason.empty(); }
};

/// `wheels` and `rails` by TrackSide, each with y growing outwards. The sigma comes from repeats: each
/// profile gets fresh noise of its own sigma, the gauge and the distance of the backs theirs, and everything
/// is computed again (GUM, Supplement 1). A difference of the radii counts in delta r but tilts no axle, as
/// in the reference cases of EN 15302.
Conicity equivalent_conicity(const std::array<RollingProfile, kSides>& wheels,
                             const std::array<RollingProfile, kSides>& rails,
                             const ConicityOptions& options = {});

/// y of the innermost point (least y) between `top_mm` and `depth_mm` below it: EN 13848-1's gauge point.
/// Nothing where the profile ends above that depth.
std::optional<double> gauge_face_of(const std::vector<Eigen::Vector2d>& rail, double top_mm, double depth_mm);

}  // namespace lightstripe
