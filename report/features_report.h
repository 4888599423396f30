// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Measured features as a page to look at.
#pragma once

#include <string>

#include "pipeline/features_job.h"

namespace lightstripe {

/// Figures over the scan with their limits, and three sections with the features drawn in.
std::string features_report_html(const FeaturesJob& job, const FeaturesResult& result);

}  // namespace lightstripe
