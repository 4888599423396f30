// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The jobs of the command line (calibrate, reconstruct, measure) for Python.
#pragma once

#include <pybind11/pybind11.h>

namespace lightstripe::python {

/// Needs Rig and Profile in the module already.
void add_jobs(pybind11::module_& module);

}  // namespace lightstripe::python
