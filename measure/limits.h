// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Limits of the measured quantities, and the verdict on a frame.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "measure/measure_profile.h"

namespace lightstripe {

/// None is set: what is allowed depends on the railway. (Austria's EisbBBV, annex 2, for wheels of more than
/// 840 mm: flange thickness 20 to 33, from 760 mm: flange height 27.5 to 36, qR at least 6.5.)
struct Limits {
  std::optional<double> vertical_wear_max, side_wear_max, corner45_wear_max, head_area_loss_max;
  std::optional<double> gauge_face_angle_max, head_width_min, lip_max, gauge_min, gauge_max, conicity_max;
  std::optional<double> flange_height_min, flange_height_max, flange_thickness_min, flange_thickness_max;
  std::optional<double> qr_min, tread_wear_max, hollow_max, rim_width_min, rim_width_max, diameter_min;
};
template <class V, class L>
void visit_fields(V&& v, L& o) requires std::is_same_v<std::remove_const_t<L>, Limits> {
  v("vertical_wear_max", o.vertical_wear_max), v("side_wear_max", o.side_wear_max);
  v("corner45_wear_max", o.corner45_wear_max), v("head_area_loss_max", o.head_area_loss_max);
  v("gauge_face_angle_max", o.gauge_face_angle_max), v("head_width_min", o.head_width_min);
  v("lip_max", o.lip_max), v("gauge_min", o.gauge_min), v("gauge_max", o.gauge_max),
      v("conicity_max", o.conicity_max);
  v("flange_height_min", o.flange_height_min), v("flange_height_max", o.flange_height_max);
  v("flange_thickness_min", o.flange_thickness_min), v("flange_thickness_max", o.flange_thickness_max);
  v("qr_min", o.qr_min), v("tread_wear_max", o.tread_wear_max), v("hollow_max", o.hollow_max);
  v("rim_width_min", o.rim_width_min), v("rim_width_max", o.rim_width_max), v("diameter_min", o.diameter_min);
}

enum class Verdict {
  kNone,  ///< no limit is set
  kPass,
  kFail,    ///< a known quantity is beyond its limit
  kUnknown  ///< none is beyond, but one that has a limit is not known
};
std::string verdict_name(Verdict verdict);

Verdict judge(const MeasuredFrame& row, const Limits& limits);

/// The limits of one quantity; a right rail's are the left one's.
struct Bounds {
  std::optional<double> low, high;
};
Bounds bounds_of(const std::string& quantity, const Limits& limits);

}  // namespace lightstripe
