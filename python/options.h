// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Keyword arguments of Python to the options of the extraction.
#pragma once

#include <pybind11/pybind11.h>

#include "extraction/extract_stripes.h"

namespace lightstripe::python {

/// stripe_width=6, method="steger", lines={"min_length": 20}: the names and texts of the option files. None
/// keeps the default. An Error names an option that does not exist or whose value does not fit.
ExtractionOptions extraction_options(const pybind11::dict& given);

}  // namespace lightstripe::python
