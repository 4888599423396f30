// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What a calibration's error does to a measured frame: it is common to all frames of a scan, and no scatter
// shows it.
#pragma once

#include <vector>

#include "core/section_bends.h"
#include "measure/measure_profile.h"

namespace lightstripe {

/// The profile with u, v as they would be if the calibration erred by `bend` as well. Not for rotary motion,
/// whose u, v are not y, z of the rig frame.
Profile bent(const Profile& profile, const SectionBends& bends, std::size_t bend);

/// Adds to the sigma, in quadrature, what one bend does to the value; nothing where either value is unknown.
void add_bend(const Estimate& bent, Estimate& estimate);

/// Adds to each sigma of `row` what the bends do to its value: `bent_rows` are measured from the bent
/// profiles, one a bend (GUM 5.1.2, with differences in the place of derivatives).
void add_bends(const std::vector<MeasuredFrame>& bent_rows, MeasuredFrame& row);

}  // namespace lightstripe
