// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// How far a wheel runs out of true over the frames of a rotary scan.
#pragma once

#include <vector>

#include "measure/measure_profile.h"

namespace lightstripe {

/// Highest less lowest over a whole turn (total indicator reading), mm.
struct RunOut {
  Estimate radial;  ///< of the tread at its datum
  Estimate axial;   ///< of the wheel's back, along the axis
};

/// Takes the mean over the rows off the extras `radial_deviation` and `axial_deviation`, which
/// measure_profile() leaves as a radius and a place along the axis. `travel` of the rows is in degrees.
/// Unknown where less than a whole turn was measured (a gap of more than 45 deg): the deviations are then
/// about the mean of what was.
RunOut find_run_out(std::vector<MeasuredFrame>& rows);

}  // namespace lightstripe
