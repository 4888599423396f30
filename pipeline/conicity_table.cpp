// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/conicity_table.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "io/number_text.h"
#include "pipeline/measurement_table.h"

namespace lightstripe {
namespace {

constexpr const char* kAmplitudeColumns = "y_mm,delta_r_mm,tan_gamma_e,tan_gamma_e_sigma\n";

void append_optional(std::string& out, const std::optional<double>& value, int decimals) {
  out.push_back(',');
  if (value) append_decimals(out, *value, decimals);
}

void append_amplitude(std::string& out, const ConicityRow& row) {
  append_decimals(out, row.y_mm, 3);
  append_optional(out, row.delta_r_mm, 6);
  append_optional(out, row.tan_gamma_e, 6);
  append_optional(out, row.sigma, 6);
  out.push_back('\n');
}

}  // namespace

std::string conicity_table(const Conicity& conicity) {
  std::string out = kAmplitudeColumns;
  for (const ConicityRow& row : conicity.rows) append_amplitude(out, row);
  return out;
}

std::string track_conicity_table(const std::vector<MeasuredFrame>& rows) {
  std::string out = "frame,travel,gauge_mm,";
  out += kAmplitudeColumns;
  for (const MeasuredFrame& row : rows) {
    const Estimate* const gauge = find_estimate(row, "gauge");
    for (const ConicityRow& at : row.conicity) {
      append_integer(out, row.frame);
      out.push_back(',');
      append_decimals(out, row.travel, 6);
      append_optional(out, gauge ? gauge->value : std::nullopt, 4);
      out.push_back(',');
      append_amplitude(out, at);
    }
  }
  return out;
}

std::string contact_table(const Conicity& conicity) {
  std::string out = "shift_mm,roll_mrad,delta_r_mm";
  for (const char* const side : {"left", "right"})
    out += fmt::format(",{0}_wheel_y_mm,{0}_rail_y_mm,{0}_slope,{0}_angle_deg,{0}_radius_mm", side);
  out += ",jump\n";
  for (const WheelsetPlace& place : conicity.walk.places) {
    append_decimals(out, place.shift_mm, 3);
    append_optional(out, 1000 * place.roll_rad, 5);
    append_optional(out, place.radius_difference_mm(), 6);
    for (const ContactPoint& contact : place.contact) {
      append_optional(out, contact.wheel_y_mm, 4);
      append_optional(out, contact.rail_y_mm, 4);
      append_optional(out, contact.slope, 6);
      append_optional(out, std::atan(contact.slope) * 180 / std::numbers::pi, 4);
      append_optional(out, contact.radius_mm, 5);
    }
    const bool jumped = place.contact[0].jumped || place.contact[1].jumped;
    out += jumped ? ",1\n" : ",0\n";
  }
  return out;
}

}  // namespace lightstripe
