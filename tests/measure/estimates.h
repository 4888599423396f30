// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Estimates of a measured section by name.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "measure/measure_profile.h"

namespace lightstripe {

inline const Estimate& estimate_of(const MeasuredFrame& row, const std::string& name) {
  for (const auto* list : {&row.estimates, &row.extras})
    for (const NamedEstimate& one : *list)
      if (one.name == name) return one.estimate;
  ADD_FAILURE() << "no " << name;
  static const Estimate none;
  return none;
}

}  // namespace lightstripe
