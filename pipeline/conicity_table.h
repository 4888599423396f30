// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Tables of equivalent conicity: of a pair of profiles, of each section of a track, and of the contact
// points.
#pragma once

#include <string>
#include <vector>

#include "measure/conicity.h"
#include "measure/measure_profile.h"

namespace lightstripe {

/// y_mm,delta_r_mm,tan_gamma_e,tan_gamma_e_sigma: one row an amplitude.
std::string conicity_table(const Conicity& conicity);

/// The same of each section, with frame,travel,gauge_mm ahead.
std::string track_conicity_table(const std::vector<MeasuredFrame>& rows);

/// shift_mm,roll_mrad,delta_r_mm and of each side wheel_y_mm,rail_y_mm,slope,angle_deg,radius_mm, then jump
/// (1: the contact leapt since the row before).
std::string contact_table(const Conicity& conicity);

}  // namespace lightstripe
