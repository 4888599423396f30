// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The errors against the known truth as a table for people.
#pragma once

#include <string>
#include <vector>

#include "truth/compare_with_truth.h"

namespace lightstripe {

/// Markdown, without a newline at its end; `wheel`: the motion is an axis.
std::string accuracy_table(const RigError& rig, const CloudError& cloud,
                           const std::vector<QuantityError>& wear, bool wheel);

}  // namespace lightstripe
