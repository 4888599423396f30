// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Where two sensors see the same surface of the head: how far apart they see it. The health of a calibration
// in service.
#pragma once

#include "measure/estimate.h"
#include "measure/surface_fit.h"

namespace lightstripe {

/// Height of sensor 0 (the lower index) over the next one on the head's top, mean over strips of the common
/// stretch, mm, + where the first lies higher. Unknown where fewer than 5 mm are common.
Estimate overlap_gap(const PlacedSection& placed);

}  // namespace lightstripe
