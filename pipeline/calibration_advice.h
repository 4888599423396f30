// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What a user does about a session that cannot be calibrated.
#pragma once

#include <string>

#include "pipeline/observe_session.h"

namespace lightstripe {

/// Half a sentence to go behind the calibration's own verdict: what most pictures were left out for, and
/// whether the folders of board and laser are swapped. Looks at some of the pictures again. Empty where there
/// is nothing to say.
std::string calibration_advice(const Session& session, const SessionObservations& seen);

}  // namespace lightstripe
