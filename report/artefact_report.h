// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The page of `lightstripe verify --artefact --report`: all checks of one body, and their drift.
#pragma once

#include <string>
#include <vector>

#include "pipeline/artefact_job.h"

namespace lightstripe {

/// `history`: checks of one body, oldest first, at least one.
std::string artefact_report_html(const std::vector<ArtefactCheck>& history);

}  // namespace lightstripe
