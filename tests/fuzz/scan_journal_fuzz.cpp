// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The journal that a killed reconstruction goes on from.

#include "fuzz_input.h"
#include "pipeline/scan_journal.h"

namespace lightstripe::fuzz {

const std::string_view kExtension = ".journal";

void read_input(const std::filesystem::path& file) { read_journal(file); }

}  // namespace lightstripe::fuzz
