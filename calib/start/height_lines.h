// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Which line of a picture is the laser's on the block of known height.
#pragma once

#include "calib/start/initial_values.h"
#include "calib/start/stripe_planes.h"

namespace lightstripe {

/// Every picture of a block shows its top and the bed beside it. The lines at their pictures' heights that
/// lie in one plane are the laser's on the tops (by the pair of lines that most pictures agree with); the
/// bed's lines taken at these heights lie in the plane of the camera's own rays, which is passed over. Fills
/// stripes[0] of the views that have a height; a picture with lines of which none fits is named in the
/// warnings, and NotUsable is thrown where more than a fifth of the pictures are such: heights in a wrong
/// order still hold many a plane, for wrong heights that follow from the true ones linearly are another
/// plane's.
void choose_height_lines(InitialValues& values, int sensor);

}  // namespace lightstripe
