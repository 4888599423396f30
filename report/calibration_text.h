// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The result of a calibration as lines of text.
#pragma once

#include <string>

#include "pipeline/observe_session.h"

namespace lightstripe {

/// What was left out, residuals of each view, lens models, errors of each sensor and of a section; no line
/// break at the end.
std::string describe_calibration(const SessionObservations& seen, const CalibrationResult& result);

}  // namespace lightstripe
