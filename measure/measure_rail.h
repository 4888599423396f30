// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Wear and shape of a rail's head, of a section registered to the unworn rail.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/fields.h"
#include "measure/estimate.h"
#include "measure/register_section.h"

namespace lightstripe {

/// left: the gauge face looks towards +y (u > 0).
enum class GaugeSide { kLeft, kRight };
constexpr std::array<EnumName<GaugeSide>, 2> enum_names(GaugeSide) {
  return {{{GaugeSide::kLeft, "left"}, {GaugeSide::kRight, "right"}}};
}

/// From where the depth of the gauge point counts.
enum class GaugeHeight {
  kMeasuredTop,  ///< "floating": from the highest point of the worn rail
  kUnwornTop     ///< "fixed": from the top of the reference
};
constexpr std::array<EnumName<GaugeHeight>, 2> enum_names(GaugeHeight) {
  return {{{GaugeHeight::kMeasuredTop, "measured-top"}, {GaugeHeight::kUnwornTop, "unworn-top"}}};
}

struct RailOptions {
  GaugeSide gauge_side = GaugeSide::kLeft;
  double gauge_point_mm = 14;  ///< below the top; 15.875 in the USA
  GaugeHeight gauge_height = GaugeHeight::kMeasuredTop;
  double lip_mm = 0.2;  ///< metal that stands out farther than this beside the head is a lip
};
template <class V>
void visit_fields(V&& v, RailOptions& o) {
  v("gauge_side", o.gauge_side, "left: the gauge face looks to +y; right: to -y");
  v("gauge_point_mm", o.gauge_point_mm, "depth of side wear and head width below the top; USA 15.875");
  v("gauge_height", o.gauge_height, "measured-top (floating) or unworn-top (fixed)");
  v("lip_mm", o.lip_mm, "metal that stands out farther than this beside the head is a lip");
}

/// In the rail's own frame: upright, origin at the unworn top.
struct RailMeasurement {
  Estimate vertical_wear;     ///< on the centreline
  Estimate side_wear;         ///< horizontal, at the gauge point
  Estimate corner45_wear;     ///< along 45 deg through the unworn gauge corner
  Estimate head_width;        ///< at the gauge point's depth
  Estimate head_area_loss;    ///< mm2, above the lower ends of the head's faces
  Estimate gauge_face_angle;  ///< deg, of the gauge face to the rail's axis, + where it leans as a new rail's
  Estimate inclination;       ///< deg, + where the top is turned towards -y
  Estimate crown_radius;      ///< within 10 mm of the centreline
  Estimate lip;               ///< mm by which metal stands out beside the gauge face; 0: none
};

/// Name and estimate, in the order of the table.
template <class V, class M>
void visit_estimates(V&& v, M& m) requires std::is_same_v<std::remove_const_t<M>, RailMeasurement> {
  v("vertical_wear", m.vertical_wear), v("side_wear", m.side_wear), v("corner45_wear", m.corner45_wear);
  v("head_width", m.head_width), v("head_area_loss", m.head_area_loss);
  v("gauge_face_angle", m.gauge_face_angle), v("inclination", m.inclination);
}

/// All unknown, with the registration's reason, where it is not usable.
RailMeasurement measure_rail(const Section& section, const ReferenceShape& reference,
                             const Registration& registration, const RailOptions& options = {});

}  // namespace lightstripe
