// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The leanest lens model whose error on views that it was not fitted to is no worse.
#pragma once

#include <vector>

#include "calib/calibrate_rig.h"
#include "calib/initial_values.h"

namespace lightstripe {

/// Fits every model to one half of a sensor's views and looks at the corners of the other half, and the other
/// way round. Of the models whose distortion is monotonic the leanest is chosen whose mean squared error
/// exceeds the best one's by no more than twice the standard error of that difference (paired by view); of
/// equally lean ones brown goes before tilted unless the tilt is better by three standard errors and 1 %.
/// Fewer than 8 views: brown4, untried.
LensChoice choose_lens(const InitialValues& values, int sensor, const CalibrationOptions& options);

}  // namespace lightstripe
