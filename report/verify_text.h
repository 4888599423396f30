// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The results of `lightstripe verify` as lines of text, without a line break at the end.
#pragma once

#include <string>

#include "calib/verify/verify_rig.h"
#include "pipeline/artefact_job.h"

namespace lightstripe {

/// Each sensor's and seam's rms.
std::string describe_verification(const Verification& verification);

/// Size, error and drift of a body of known size.
std::string describe_check(const ArtefactCheck& check);

}  // namespace lightstripe
