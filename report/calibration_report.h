// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// calibration.html: one file that opens offline.
#pragma once

#include <string>

#include "pipeline/observe_session.h"

namespace lightstripe {

/// The whole page: verdict, uncertainty, residuals, rig, pictures. Libraries and pictures are inside.
std::string calibration_report(const SessionObservations& seen, const CalibrationResult& result);

}  // namespace lightstripe
