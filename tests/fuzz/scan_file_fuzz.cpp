// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What can be read is written back to text that reads back the same; its extraction options are read as well.

#include "core/error.h"
#include "extraction/extract_stripes.h"
#include "fuzz_input.h"
#include "io/atomic_file.h"
#include "io/session_file.h"

namespace lightstripe::fuzz {

const std::string_view kExtension = ".yaml";

void read_input(const std::filesystem::path& file) {
  const Scan scan = read_scan(file);
  const std::string text = scan_to_yaml(scan);
  write_file(file, text);
  std::string again;
  try {
    again = scan_to_yaml(read_scan(file));
  } catch (const Error& error) {
    LIGHTSTRIPE_CHECK(false, std::string("the written scan is refused: ") + error.what());
  }
  LIGHTSTRIPE_CHECK(again == text, "the written scan reads back otherwise");
  ExtractionOptions options;
  read_subtree(scan.extraction, options);
}

}  // namespace lightstripe::fuzz
