// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Pixels looked at where they lie in the file: all within it, and those that the decoder gives.

#include "core/error.h"
#include "fuzz_input.h"
#include "io/atomic_file.h"
#include "io/image_header.h"
#include "io/images.h"
#include "io/plain_pixels.h"

namespace lightstripe::fuzz {

const std::string_view kExtension = ".bin";

void read_input(const std::filesystem::path& file) {
  const std::string bytes = read_file(file);
  const auto found = find_plain_pixels(bytes);
  if (!found) return;
  LIGHTSTRIPE_CHECK(found->width > 0 && found->height > 0, "a view has pixels");
  for (const int y : {0, found->height - 1}) {
    const auto* const first = reinterpret_cast<const char*>(found->row(y));
    LIGHTSTRIPE_CHECK(first >= bytes.data() && first + found->width <= bytes.data() + bytes.size(),
                      "the pixels lie in the file");
  }
  if (found->width > 256 || found->height > 256) return;
  const Image8 image = read_image(file, Channel::kGray);
  LIGHTSTRIPE_CHECK(image.width == found->width && image.height == found->height, "the sizes are one");
  for (int y = 0; y < image.height; ++y)
    LIGHTSTRIPE_CHECK(std::equal(image.row(y), image.row(y) + image.width, found->row(y)),
                      "so are the pixels");
}

}  // namespace lightstripe::fuzz
