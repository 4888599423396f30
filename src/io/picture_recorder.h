// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Writes the pictures of a recording as fast as they come; each appears under its name only when it is whole.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "core/fields.h"
#include "core/image.h"
#include "io/growing_tiff.h"

namespace lightstripe {

enum class PictureFormat { kPgm, kPng };
constexpr std::array<EnumName<PictureFormat>, 2> enum_names(PictureFormat) {
  return {{{PictureFormat::kPgm, "pgm"}, {PictureFormat::kPng, "png"}}};
}

class PictureRecorder {
 public:
  /// Makes the folder; an Error where it holds pictures already. A name that ends in .tif is one file that
  /// grows (GrowingTiff); an Error where it is there already.
  PictureRecorder(const std::filesystem::path& place, PictureFormat format);

  /// "0000012.pgm"; 8 or 16 bits as the picture has. An Error names the file (disk full), and nothing of it
  /// is left.
  void write(std::int64_t frame, const GreyImage& image);
  /// What the picture is, or will be, called: "0000012.pgm", or "scan.tif#11" by its page.
  std::string name(std::int64_t frame) const;
  /// The number by which a scan finds the picture written next: its own, or its page's.
  std::int64_t scan_number(std::int64_t frame) const;

  /// Whether a recording of this name is one file.
  static bool is_one_file(const std::filesystem::path& place);
  /// A table or note that belongs to the recording: within its folder, or beside its file.
  static std::filesystem::path beside(const std::filesystem::path& place, const std::string& name);

 private:
  std::filesystem::path place_;
  PictureFormat format_;
  std::optional<GrowingTiff> file_;
};

}  // namespace lightstripe
