// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The guard before the decoders: looks at bytes only.

#include "fuzz_input.h"
#include "io/atomic_file.h"
#include "io/image_header.h"

namespace lightstripe::fuzz {

const std::string_view kExtension = ".bin";

void read_input(const std::filesystem::path& file) { inspect_image(read_file(file)); }

}  // namespace lightstripe::fuzz
