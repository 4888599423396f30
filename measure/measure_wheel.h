// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Flange and tread of a wheel's section.
#pragma once

#include <optional>
#include <string_view>
#include <type_traits>

#include "measure/estimate.h"
#include "measure/register_section.h"

namespace lightstripe {

struct WheelOptions {
  double datum_mm = 70;        ///< tread datum from the wheel's back
  double face_height_mm = 10;  ///< of the flange thickness above the datum
  double qr_below_tip_mm = 2;
};
template <class V>
void visit_fields(V&& v, WheelOptions& o) {
  v("datum_mm", o.datum_mm, "tread datum from the wheel's back");
  v("face_height_mm", o.face_height_mm, "height above the datum where the flange's thickness is taken");
  v("qr_below_tip_mm", o.qr_below_tip_mm, "depth below the flange's tip where qR ends");
}

/// What the section's own coordinates mean.
struct WheelSectionKind {
  bool radial = false;                          ///< v is the radius
  std::optional<double> radius_offset_mm = {};  ///< an aligned file: radius at the datum where its v is 0
  std::optional<double> axis_sigma_mm = {};     ///< 1-sigma of the axis' distance, from the rig's calibration
  bool back_is_given = false;                   ///< an aligned file: the wheel's back is where its frame says
};

struct WheelMeasurement {
  Estimate flange_height;     ///< Sh: tip over datum
  Estimate flange_thickness;  ///< Sd: back to face, 10 above the datum
  Estimate qr;                ///< face 10 above the datum to face 2 below the tip, horizontally
  Estimate tread_wear;        ///< at the datum, the flange's tip taken as unworn
  Estimate hollow;            ///< depth of the tread below its highest point on the field side
  Estimate rim_width;         ///< back to outer face
  Estimate diameter;          ///< at the datum
  Estimate radius;            ///< at the datum; unlike the diameter's, sigma leaves the axis' own error out
  Estimate back_place;        ///< of the back along the axis, + to the field side; rotary scans only
};

/// The quantities of the table.
template <class V, class M>
void visit_estimates(V&& v, M& m) requires std::is_same_v<std::remove_const_t<M>, WheelMeasurement> {
  v("flange_height", m.flange_height), v("flange_thickness", m.flange_thickness), v("qr", m.qr);
  v("tread_wear", m.tread_wear), v("hollow", m.hollow);
  v("rim_width", m.rim_width), v("diameter", m.diameter);
}

/// All unknown, with the registration's reason, where it is not usable. All but tread wear come from the
/// section itself; the reference only tells which end is the back, and where it lies if it is not seen.
WheelMeasurement measure_wheel(const Section& section, const ReferenceShape& reference,
                               const Registration& registration, const WheelSectionKind& kind,
                               const WheelOptions& options = {});

}  // namespace lightstripe
