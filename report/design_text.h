// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What a sensor will measure, as a table for people.
#pragma once

#include <string>

#include "reconstruct/sensor_design.h"

namespace lightstripe {

std::string describe_design(const SensorDesign& design, const DesignAnswer& answer);

}  // namespace lightstripe
