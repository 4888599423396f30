// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Nominal outlines of rails and wheels: configs/profiles/*.yaml, also built into the program.
#pragma once

#include <string>
#include <vector>

#include "core/outline.h"

namespace lightstripe {

/// A built-in outline by its name ("60E1"), or a file of the same format by its path (a text with a '/' or
/// that ends in .yaml). Closed, counterclockwise, u lateral, v up, mm; origin at the top of a rail, at a
/// wheel's tread datum. Polynomials become chains of arcs. An Error where there is none, segments do not join
/// or an arc's ends differ in their distance from its centre.
Outline read_nominal(const std::string& name_or_path);

/// As read_nominal, with what the file says of itself.
struct NominalProfile {
  std::string name, kind;  ///< kind: "rail" or "wheel"
  Outline outline;
};
NominalProfile read_nominal_profile(const std::string& name_or_path);

/// The names of the built-in outlines.
std::vector<std::string> nominal_names();

}  // namespace lightstripe
