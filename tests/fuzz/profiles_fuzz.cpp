// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// profiles.csv: what can be read is written back to a table that reads back the same.

#include "core/error.h"
#include "fuzz_input.h"
#include "io/atomic_file.h"
#include "io/tables.h"

namespace lightstripe::fuzz {

const std::string_view kExtension = ".csv";

namespace {

std::string table_of(const std::vector<Profile>& profiles) {
  std::string text(kProfilesHeader);
  for (const auto& profile : profiles) append_profile(text, profile);
  return text;
}

}  // namespace

void read_input(const std::filesystem::path& file) {
  const std::string text = table_of(read_profiles(file));
  write_file(file, text);
  std::string again;
  try {
    again = table_of(read_profiles(file));
  } catch (const Error& error) {
    LIGHTSTRIPE_CHECK(false, std::string("the written profiles are refused: ") + error.what());
  }
  LIGHTSTRIPE_CHECK(again == text, "the written profiles read back otherwise");
}

}  // namespace lightstripe::fuzz
