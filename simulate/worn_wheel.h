// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A nominal wheel section with worn flange and tread, and what an inspector would measure on it.
// Section frame: u along the axis from the tread datum (70 mm from the wheel's back), + to the field side;
// v = radius minus the nominal datum's radius; mm.
#pragma once

#include "core/outline.h"

namespace lightstripe {

struct WheelWear {
  double flange_mm = 0;  ///< how far the flange's active face has moved towards the back
  double tread_mm = 0;   ///< how much lower the tread is at the datum
};

/// The flange's face moves by flange_mm between u = -36 and v = 12, less and less (smoothly) down to u = -22
/// where the tread begins and up to the tip, which stays; where it would then overhang, it stands upright.
/// The tread sinks by a hollow 60 mm wide, deepest at the datum. Material is only ever taken away. An unworn
/// section comes back as it is, a worn one as short straight pieces of about `spacing_mm`. An Error where the
/// section is no wheel's or nothing would be left of the flange.
Outline worn_wheel(const Outline& nominal, const WheelWear& wear, double spacing_mm = 0.05);

struct WheelDimensions {
  double flange_height = 0;     ///< Sh: tip above the tread at the datum
  double flange_thickness = 0;  ///< Sd: back to active face, 10 mm above the datum point
  double qr = 0;                ///< between the face 10 mm above the datum point and 2 mm below the tip
  double hollow = 0;            ///< largest rise of the tread towards the field side, from u = -26 on
  double rim_width = 0;         ///< back to outer face
};

/// From a section that worn_wheel() gives, by its definitions (railway practice: L1 = 2, L2 = 70, L3 = 10
/// mm).
WheelDimensions measure_wheel_section(const Outline& section);

}  // namespace lightstripe
