// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What each <reader>_fuzz.cpp defines; entry.cpp hands it every input as a file.
#pragma once

#include <filesystem>
#include <string_view>

namespace lightstripe::fuzz {

/// Of the input file, with the dot: some readers choose the format by it.
extern const std::string_view kExtension;

/// Reads the file. An Error is a good answer to a bad file; every other exception, a failed assertion, a
/// fault that a sanitizer sees, or an answer that breaks the reader's promise (std::logic_error) is a
/// finding.
void read_input(const std::filesystem::path& file);

}  // namespace lightstripe::fuzz
