// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Writes the pictures of a recording as fast as they come; each appears under its name only when it is whole.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/fields.h"
#include "core/image.h"

namespace lightstripe {

enum class PictureFormat { kPgm, kPng };
constexpr std::array<EnumName<PictureFormat>, 2> enum_names(PictureFormat) {
  return {{{PictureFormat::kPgm, "pgm"}, {PictureFormat::kPng, "png"}}};
}

class PictureRecorder {
 public:
  /// Makes the folder; an Error where it holds pictures already.
  PictureRecorder(const std::filesystem::path& folder, PictureFormat format);

  /// "0000012.pgm"; 8 or 16 bits as the picture has. An Error names the file (disk full), and nothing of it
  /// is left.
  void write(std::int64_t frame, const GreyImage& image);
  std::string name(std::int64_t frame) const;

 private:
  std::filesystem::path folder_;
  PictureFormat format_;
};

}  // namespace lightstripe
