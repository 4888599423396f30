// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "options.h"

#include <string>

#include "io/yaml_binding.h"

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

void apply(const py::dict& given, const std::string& prefix, ExtractionOptions& options) {
  for (const auto& [key, value] : given) {
    const std::string name = prefix + py::str(key).cast<std::string>();
    if (py::isinstance<py::dict>(value)) {
      apply(py::reinterpret_borrow<py::dict>(value), name + ".", options);
    } else if (!value.is_none()) {
      set_field(options, name, text_of(value, name));
    }
  }
}

}  // namespace

ExtractionOptions extraction_options(const py::dict& given) {
  ExtractionOptions options;
  apply(given, "", options);
  return options;
}

}  // namespace lightstripe::python
