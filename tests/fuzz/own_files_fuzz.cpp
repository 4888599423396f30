// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The marker of files that a program may delete: whoever has changed it, nothing outside the folder is named.

#include "core/error.h"
#include "fuzz_input.h"
#include "io/own_files.h"

namespace lightstripe::fuzz {

const std::string_view kExtension = ".txt";

void read_input(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.parent_path();
  const OwnFiles own(folder, file.filename().string());
  for (const std::string& name : own.files()) {
    const auto inside = (folder / name).lexically_normal().lexically_relative(folder.lexically_normal());
    LIGHTSTRIPE_CHECK(!inside.empty() && *inside.begin() != "..", "the file lies in the folder");
  }
}

}  // namespace lightstripe::fuzz
