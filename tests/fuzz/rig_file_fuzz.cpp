// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What can be read is written back to text that reads back the same.

#include "core/error.h"
#include "fuzz_input.h"
#include "io/atomic_file.h"
#include "io/rig_file.h"

namespace lightstripe::fuzz {

const std::string_view kExtension = ".yaml";

void read_input(const std::filesystem::path& file) {
  const std::string text = rig_to_yaml(read_rig(file));
  write_file(file, text);
  std::string again;
  try {
    again = rig_to_yaml(read_rig(file));
  } catch (const Error& error) {
    LIGHTSTRIPE_CHECK(false, std::string("the written rig is refused: ") + error.what());
  }
  LIGHTSTRIPE_CHECK(again == text, "the written rig reads back otherwise");
}

}  // namespace lightstripe::fuzz
