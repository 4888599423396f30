// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// "lines.min_length=3": a field's dotted name and text as the command line gives them.

#include "extraction/extract_stripes.h"
#include "fuzz_input.h"
#include "io/atomic_file.h"
#include "io/yaml_binding.h"

namespace lightstripe::fuzz {

const std::string_view kExtension = ".txt";

void read_input(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  const std::size_t split = std::min(text.find('='), text.size());
  ExtractionOptions options;
  set_field(options, std::string_view(text).substr(0, split), text.substr(std::min(split + 1, text.size())),
            "--extraction");
}

}  // namespace lightstripe::fuzz
