// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/quantity_text.h"

#include <algorithm>
#include <map>

namespace lightstripe {

QuantityText quantity_text(const std::string& name) {
  static const std::map<std::string, QuantityText> kTexts{
      {"vertical_wear", {"Vertical wear", "mm", 3}},
      {"side_wear", {"Side wear", "mm", 3}},
      {"corner45_wear", {"Wear of the corner at 45°", "mm", 3}},
      {"head_width", {"Head width", "mm", 3}},
      {"head_area_loss", {"Head area lost", "mm²", 1}},
      {"gauge_face_angle", {"Gauge face angle", "°", 2}},
      {"inclination", {"Inclination", "°", 3}},
      {"crown_radius", {"Crown radius", "mm", 0}},
      {"lip", {"Lip", "mm", 3}},
      {"overlap_gap", {"Gap between the sensors", "mm", 3}},
      {"gauge", {"Track gauge", "mm", 2}},
      {"conicity", {"Equivalent conicity at 3 mm", "", 4}},
      {"conicity_nonlinearity", {"Conicity at 4 mm less that at 2 mm, per mm", "1/mm", 4}},
      {"flange_height", {"Flange height Sh", "mm", 3}},
      {"flange_thickness", {"Flange thickness Sd", "mm", 3}},
      {"qr", {"Flange slope qR", "mm", 3}},
      {"tread_wear", {"Tread wear", "mm", 3}},
      {"hollow", {"Hollow tread", "mm", 3}},
      {"rim_width", {"Rim width", "mm", 2}},
      {"diameter", {"Diameter", "mm", 2}},
      {"radial_deviation", {"Radial deviation", "mm", 3}},
      {"axial_deviation", {"Axial deviation", "mm", 3}}};
  constexpr std::string_view kRight = "right_";
  if (const auto found = kTexts.find(name); found != kTexts.end()) return found->second;
  if (name.starts_with(kRight)) {
    QuantityText text = quantity_text(name.substr(kRight.size()));
    text.label = "Right rail: " + text.label;
    return text;
  }
  QuantityText text{name, "mm", 3};
  std::replace(text.label.begin(), text.label.end(), '_', ' ');
  return text;
}

}  // namespace lightstripe
