// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// TIFF 6.0, section 2 "TIFF Structure"; BigTIFF: the same with 8-byte counts and offsets.
#include "io/tiff_header.h"

#include "io/byte_reader.h"
#include "io/tiff_tags.h"

namespace lightstripe {
namespace {

/// One entry of a directory: `count` numbers of `size` bytes at `at`.
struct PlacedNumbers {
  std::uint64_t count = 0, at = 0;
  int size = 0;
};

int bytes_of_place(std::uint64_t type) {
  switch (type) {
    case 1:
      return 1;  // BYTE
    case 3:
      return 2;  // SHORT
    case 4:
      return 4;  // LONG
    case 16:
      return 8;  // LONG8
    default:
      return 0;
  }
}

class HeaderDirectory {
 public:
  explicit HeaderDirectory(std::string_view bytes) : in_{bytes, bytes[0] == 'M'} {
    const bool big = in_.u16(2) == 43;
    offset_size_ = big ? 8 : 4;
    const std::uint64_t start = in_.number(big ? 8 : 4, offset_size_);
    num_entries_ = in_.number(start, big ? 8 : 2);
    first_ = start + (big ? 8 : 2);
    entry_size_ = big ? 20 : 12;
  }

  /// The entry of this tag; a count of 0 where there is none.
  PlacedNumbers find(TiffTag tag) {
    for (std::uint64_t i = 0; i < num_entries_ && !in_.beyond_end; ++i) {
      const std::uint64_t at = first_ + i * entry_size_;
      if (in_.u16(at) != tag) continue;
      PlacedNumbers entry;
      entry.size = bytes_of_place(in_.u16(at + 2));
      entry.count = in_.number(at + 4, offset_size_);
      const std::uint64_t value_at = at + 4 + static_cast<std::uint64_t>(offset_size_);
      const bool inside =
          entry.count <= static_cast<std::uint64_t>(offset_size_) &&
          entry.count * static_cast<std::uint64_t>(entry.size) <= static_cast<std::uint64_t>(offset_size_);
      entry.at = inside ? value_at : in_.number(value_at, offset_size_);
      return entry;
    }
    return {};
  }

  std::uint64_t value(const PlacedNumbers& entry, std::uint64_t index) {
    return in_.number(entry.at + index * static_cast<std::uint64_t>(entry.size), entry.size);
  }
  bool beyond_end() const { return in_.beyond_end; }

 private:
  ByteReader in_;
  int offset_size_ = 4;
  std::uint64_t num_entries_ = 0, first_ = 0, entry_size_ = 12;
};

bool parts_inside(HeaderDirectory& directory, TiffTag offsets_tag, TiffTag counts_tag,
                  std::uint64_t file_size) {
  const PlacedNumbers offsets = directory.find(offsets_tag), counts = directory.find(counts_tag);
  if (offsets.count != counts.count)
    return counts.count == 0;  // old writers leave the counts out: libtiff judges
  for (std::uint64_t i = 0; i < offsets.count && !directory.beyond_end(); ++i) {
    const std::uint64_t at = directory.value(offsets, i), length = directory.value(counts, i);
    if (at > file_size || file_size - at < length) return false;
  }
  return true;
}

}  // namespace

ImageHeader inspect_tiff(std::string_view bytes) {
  HeaderDirectory directory(bytes);
  ImageHeader header{ImageFormat::kTiff, 0, 0, 0, "", 0};
  const PlacedNumbers width = directory.find(kTiffWidth), height = directory.find(kTiffHeight);
  if (width.count > 0) header.width = static_cast<std::int64_t>(directory.value(width, 0));
  if (height.count > 0) header.height = static_cast<std::int64_t>(directory.value(height, 0));
  const bool whole = parts_inside(directory, kTiffStripOffsets, kTiffStripByteCounts, bytes.size()) &&
                     parts_inside(directory, kTiffTileOffsets, kTiffTileByteCounts, bytes.size());
  if (!whole || directory.beyond_end()) header.damage = "ends before its picture does";
  return header;
}

}  // namespace lightstripe
