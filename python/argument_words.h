// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The jobs speak of the command line's options; who calls them from Python gave arguments.
#pragma once

#include <string>
#include <vector>

namespace lightstripe::python {

/// The message with `resume` for --resume. What stands between backticks is a command line and stays.
std::string in_arguments(const std::string& message);
std::vector<std::string> in_arguments(std::vector<std::string> messages);

}  // namespace lightstripe::python
