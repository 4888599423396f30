// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/calibration_errors.h"

#include <algorithm>

#include "io/rig_file.h"
#include "io/yaml_binding.h"
#include "measure/profile_formats.h"
#include "measure/section.h"

namespace lightstripe {
namespace {

std::string why_bends_do_not_hold(const Rig& rig, const std::filesystem::path& table,
                                  const std::vector<Profile>& sections) {
  if (profile_format(table.string())) return "the sections of a railway file lie in no rig's frame";
  const auto& bends = rig.quality.section_bends;
  if (!bends || bends->bends.empty())
    return "the rig file does not tell how its calibration may bend a section (quality.section_bends)";
  if (rig.motion.type == MotionType::kRotary && !sections_are_radial(sections))
    return "the rig turns, and the sections' v is no distance from its axis";
  return "";
}

/// The larger of the axis point's sigmas.
std::optional<double> axis_sigma(const RigQuality& quality) {
  std::optional<double> largest;
  for (const auto& [name, sigma] : quality.sigma)
    if (name.find("axis_point") != std::string::npos) largest = std::max(largest.value_or(0), sigma);
  return largest;
}

}  // namespace

CalibrationErrors calibration_errors(const std::filesystem::path& rig_file,
                                     const std::filesystem::path& table,
                                     const std::vector<Profile>& sections) {
  if (rig_file.empty()) return {};
  const Rig rig = read_rig(rig_file);
  CalibrationErrors out;
  out.rig_file = rig_file;
  out.why_not = why_bends_do_not_hold(rig, table, sections);
  if (out.counted()) {
    // Place and axis are among the errors that bend the sections: each counts once.
    out.bends = *rig.quality.section_bends;
    out.place_sigma_mm = 0;
    if (rig.motion.type == MotionType::kRotary) out.axis_sigma_mm = 0;
    return out;
  }
  if (rig.quality.section_absolute_sigma_mm > 0) out.place_sigma_mm = rig.quality.section_absolute_sigma_mm;
  out.axis_sigma_mm = axis_sigma(rig.quality);
  return out;
}

std::string calibration_yaml(const CalibrationErrors& errors) {
  return "calibration_error: " + yaml_text(errors.counted() ? "counted" : "not counted: " + errors.why_not) +
         "\n";
}

std::string calibration_word(const CalibrationErrors& errors) {
  return errors.counted() ? "counted" : "not counted";
}

}  // namespace lightstripe
