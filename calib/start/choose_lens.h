// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The leanest lens model whose error on views that it was not fitted to is no worse.
#pragma once

#include <vector>

#include "calib/calibration.h"
#include "calib/start/initial_values.h"

namespace lightstripe {

/// Fits every model to one half of a sensor's views and looks at the corners of the other half, and the other
/// way round. From the leanest of the models whose distortion is monotonic on, a richer one takes over where
/// its mean squared error is smaller by more than three standard errors of the difference (paired by view)
/// and 0.2 %, a tilted one where it is smaller by 1 %. Corners that no model explains do not count. Fewer
/// than 8 views: brown4, untried.
LensChoice choose_lens(const InitialValues& values, int sensor, const CalibrationOptions& options);

}  // namespace lightstripe
