// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The conicity of a wheelset on a track as a page to look at.
#pragma once

#include <string>

#include "pipeline/conicity_job.h"

namespace lightstripe {

/// tan gamma_e with its error, the rolling radius difference, contact points and angles over the shift.
std::string conicity_report_html(const ConicityJob& job, const Conicity& conicity);

}  // namespace lightstripe
