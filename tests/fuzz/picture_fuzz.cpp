// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A picture through the guard and the decoders, of at most 2^16 pixels so that runs stay short.

#include "core/error.h"
#include "fuzz_input.h"
#include "io/atomic_file.h"
#include "io/image_header.h"
#include "io/images.h"

namespace lightstripe::fuzz {

const std::string_view kExtension = ".bin";

void read_input(const std::filesystem::path& file) {
  const ImageHeader header = inspect_image(read_file(file));
  if (header.width > 256 || header.height > 256) return;
  const Image8 image = read_image(file);
  LIGHTSTRIPE_CHECK(image.width == header.width && image.height == header.height,
                    "the header tells the size");
}

}  // namespace lightstripe::fuzz
