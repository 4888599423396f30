// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/calibration_error_text.h"

#include <fmt/format.h>

namespace lightstripe {

Messages describe_calibration_error(const RigOfSections& rig, const CalibrationErrors& errors,
                                    const std::filesystem::path& table) {
  Messages out;
  if (!rig.warning.empty()) out.warn(rig.warning);
  if (errors.counted())
    out.say(fmt::format("the sigmas count the calibration's error: {}{}", rig.file.string(),
                        rig.by_record ? ", the rig that made " + table.filename().string() : ""));
  else if (!rig.file.empty() && rig.by_record)  // a rig written by hand
    out.say("the sigmas do not count the calibration's error: " + errors.why_not);
  else if (!rig.file.empty())
    out.warn("the sigmas do not count the calibration's error: " + errors.why_not);
  else if (rig.warning.empty() && table.extension() == ".csv")
    out.say("the sigmas do not count the calibration's error: give --rig rig.yaml");
  return out;
}

}  // namespace lightstripe
