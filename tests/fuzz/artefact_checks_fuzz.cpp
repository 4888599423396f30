// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The table of daily checks.

#include "fuzz_input.h"
#include "pipeline/artefact_job.h"

namespace lightstripe::fuzz {

const std::string_view kExtension = ".csv";

void read_input(const std::filesystem::path& file) { read_artefact_checks(file); }

}  // namespace lightstripe::fuzz
