// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The section of a worn rail.
#pragma once

#include "core/outline.h"

namespace lightstripe {

/// Crown and shoulders lowered by `vertical_mm`, the gauge face (u > 0) moved in by `side_mm`, both corners
/// rounded anew with the nominal corner radius, tangent to shoulder and face: on the centreline the rail is
/// exactly `vertical_mm` lower, the gauge face exactly `side_mm` further in. Everything below the head's
/// faces stays; a moved face ends with a sharp edge. `nominal`: a mirrored outline that begins at the top
/// with arc, arc, arc, line (crown, shoulder, corner, face) and goes on with the lower corner and the fishing
/// surface. An Error where the outline has no such head or the wear eats up an arc.
Outline worn_rail(const Outline& nominal, double vertical_mm, double side_mm);

}  // namespace lightstripe
