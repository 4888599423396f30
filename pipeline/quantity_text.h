// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What the columns of measurements.csv are called in front of people.
#pragma once

#include <string>

namespace lightstripe {

struct QuantityText {
  std::string label;  ///< "Vertical wear"
  std::string unit;   ///< "mm", "mm²", "°"
  int decimals = 3;
};

/// By the column's name; one that is not known keeps its name, in mm. A right rail's say so.
QuantityText quantity_text(const std::string& name);

}  // namespace lightstripe
