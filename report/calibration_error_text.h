// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Whether the sigmas of a measurement count what the calibration errs by, in a sentence.
#pragma once

#include <filesystem>
#include <string>

#include "pipeline/calibration_errors.h"
#include "pipeline/rig_of_sections.h"
#include "report/message.h"

namespace lightstripe {

/// A warning where what the user has given, or a record names, does not serve. `table`: the sections.
Messages describe_calibration_error(const RigOfSections& rig, const CalibrationErrors& errors,
                                    const std::filesystem::path& table);

}  // namespace lightstripe
