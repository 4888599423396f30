// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Which way up, and which way round, a recorded profile lies.
#pragma once

#include "measure/profile_formats.h"

namespace lightstripe {

/// Makes v point up and, of a wheel, u run from the flange's back (at -70) to the field side; found from the
/// shape: a rail's top is above its sides, a wheel's flange above its tread and at the file's x = 0 or,
/// where x counts from the tread datum, at its end.
void turn_upright(RecordedProfile& profile);

}  // namespace lightstripe
