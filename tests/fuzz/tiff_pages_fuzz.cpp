// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A TIFF of many pages, also one that is still growing: each page read, and looked at where it lies.

#include "core/error.h"
#include "fuzz_input.h"
#include "io/tiff_pages.h"

namespace lightstripe::fuzz {

const std::string_view kExtension = ".tif";

void read_input(const std::filesystem::path& file) {
  constexpr std::int64_t kMostPages = 4;
  const auto pages = open_tiff_pages(file, Channel::kGray);
  if (!pages) return;  // one page, or no TIFF
  for (std::int64_t i = 0; i < std::min(kMostPages, pages->size()); ++i) {
    const GreyImage read = pages->read(i);
    const GreyImage looked = pages->look(i).image();
    LIGHTSTRIPE_CHECK(read.index() != looked.index() || std::visit(
                                                            [&](const auto& image) {
                                                              using Same = std::decay_t<decltype(image)>;
                                                              return image.pixels ==
                                                                     std::get<Same>(looked).pixels;
                                                            },
                                                            read),
                      "one page has one content");
  }
}

}  // namespace lightstripe::fuzz
