// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Options given as Python values -> the options structs, through the field lists that read the files as well.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "io/yaml_binding.h"

namespace lightstripe::python {

/// An option as the files know it: a dotted key and its text.
struct OptionText {
  std::string key, text;
};

/// {"roi": (0, 0, 100, 100), "lines": {"min_length": 20}} -> roi 0,0,100,100 and lines.min_length 20. None
/// keeps the default and is left out; None inside a list is a TypeError.
std::vector<OptionText> option_texts(const pybind11::dict& given);

/// Sets fields of an options struct. An Error names an option that does not exist or whose value does not
/// fit.
template <HasFields T>
void apply_options(T& options, const pybind11::dict& given, const std::string& origin = "option") {
  for (const OptionText& option : option_texts(given)) set_field(options, option.key, option.text, origin);
}

}  // namespace lightstripe::python
