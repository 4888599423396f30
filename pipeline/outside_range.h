// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What a scan says about lines beyond the range in which a rig with several laser planes was calibrated.
#pragma once

#include <string>
#include <vector>

#include "core/rig.h"
#include "reconstruct/scanner.h"

namespace lightstripe {

/// One sentence for each sensor that has dropped such lines: how many of their points, and which depth_range
/// would keep those whose plane is certain.
std::vector<std::string> outside_range_texts(const std::vector<OutsideRange>& outside, const Rig& rig);

/// Why there is nothing although lines were seen: none of them gave a point. With the sentences above.
std::string why_all_missed(const ScanSummary& summary, const std::vector<std::string>& outside_range);

}  // namespace lightstripe
