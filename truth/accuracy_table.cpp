// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "truth/accuracy_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/counted.h"

namespace lightstripe {

std::string accuracy_table(const RigError& rig, const CloudError& cloud,
                           const std::vector<QuantityError>& wear, bool wheel) {
  std::string table;
  const auto row = [&](const std::string& what, const std::string& value) {
    table += fmt::format("| {:<58} | {:>12} |\n", what, value);
  };
  const auto row_of = [&](const QuantityError& one) {
    std::string name = one.name;
    std::replace(name.begin(), name.end(), '_', ' ');
    // A wheel that runs out of true has another diameter in each section, its truth is the mean's.
    if (one.name == "diameter")
      row("diameter, mean of the turn", fmt::format("{:.3f} mm", std::abs(one.mean_mm)));
    else
      row(fmt::format("{} of {}, rms", name, counted(one.frames, "section")),
          fmt::format("{:.4f} mm", one.rms_mm));
  };
  row("result against the known truth", "error");
  table += fmt::format("|{:-<60}|{:->13}:|\n", "", "");
  for (const auto& sensor : rig.sensors) {
    row(fmt::format("laser plane of {}, direction", sensor.name),
        fmt::format("{:.3f} deg", sensor.plane_angle_deg));
    row(fmt::format("laser plane of {}, place", sensor.name),
        fmt::format("{:.3f} mm", sensor.plane_offset_mm));
  }
  if (rig.sensors.size() > 1) row("sensor to sensor", fmt::format("{:.3f} mm", rig.baseline_mm));
  row(wheel ? "axis, direction" : "direction of travel", fmt::format("{:.3f} deg", rig.travel_deg));
  if (wheel) row("axis, place", fmt::format("{:.3f} mm", rig.axis_mm));
  row("sections, shape after one rigid move each, rms", fmt::format("{:.4f} mm", cloud.shape_rms_mm));
  row("sections, place as well, rms", fmt::format("{:.3f} mm", cloud.absolute_rms_mm));
  row("points more than 1 mm off", fmt::format("{:.3f} %", 100 * cloud.far_fraction));
  row("visible lit stripe recovered", fmt::format("{:.1f} %", 100 * cloud.recovered_fraction));
  for (const QuantityError& one : wear) row_of(one);
  table.pop_back();
  return table;
}

}  // namespace lightstripe
