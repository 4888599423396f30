// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// `moves: rig | object` of session and rig files.
#pragma once

#include <array>

#include "core/fields.h"

namespace lightstripe {

enum class MovingPart { kRig, kObject };

constexpr std::array<EnumName<MovingPart>, 2> enum_names(MovingPart) {
  return {{{MovingPart::kRig, "rig"}, {MovingPart::kObject, "object"}}};
}

constexpr MovingPart moving_part(bool rig_moves) {
  return rig_moves ? MovingPart::kRig : MovingPart::kObject;
}

}  // namespace lightstripe
