// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "options.h"

#include <string>
#include <vector>

namespace lightstripe::python {
namespace {

namespace py = pybind11;

/// A Python value as the text that the option has in a file: True -> true, (0, 0, 100, 100) -> 0,0,100,100.
std::string text_of(py::handle value, const std::string& name) {
  if (value.is_none()) throw py::type_error(name + ": None cannot stand inside a list of values");
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
  if (py::isinstance<py::tuple>(value) || py::isinstance<py::list>(value)) {
    std::string text;
    for (const py::handle& part : value) text += (text.empty() ? "" : ",") + text_of(part, name);
    return text;
  }
  return py::str(value).cast<std::string>();
}

void collect(const py::dict& given, const std::string& prefix, std::vector<OptionText>& texts) {
  for (const auto& [key, value] : given) {
    const std::string name = prefix + py::str(key).cast<std::string>();
    if (py::isinstance<py::dict>(value)) {
      collect(py::reinterpret_borrow<py::dict>(value), name + ".", texts);
    } else if (!value.is_none()) {
      texts.push_back({name, text_of(value, name)});
    }
  }
}

}  // namespace

std::vector<OptionText> option_texts(const py::dict& given) {
  std::vector<OptionText> texts;
  collect(given, "", texts);
  return texts;
}

}  // namespace lightstripe::python
