// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/tiff_page_cut.h"

#include <algorithm>
#include <array>
#include <optional>

#include "io/byte_reader.h"
#include "io/tiff_tags.h"

namespace lightstripe {
namespace {

constexpr std::uint64_t kMaxPageBytes = std::uint64_t{1} << 30;
constexpr std::uint64_t kMaxEntries = 1024;
/// What decoding needs: size, bits, compression, colours, strips, tiles, orientation. Pointers to other
/// directories (EXIF, thumbnails) stay behind.
bool decoding_needs(std::uint64_t tag) {
  constexpr std::array<std::uint64_t, 33> kTags = {254, 255, 256, 257, 258, 259, 262, 266, 273, 274, 277,
                                                   278, 279, 280, 281, 282, 283, 284, 292, 293, 296, 317,
                                                   320, 322, 323, 324, 325, 338, 339, 347, 530, 531, 532};
  return std::binary_search(kTags.begin(), kTags.end(), tag);
}

std::uint64_t bytes_of_type(std::uint64_t type) {
  constexpr std::array<std::uint64_t, 19> kSizes = {0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8, 4, 0, 0, 8, 8, 8};
  return type < kSizes.size() ? kSizes.at(type) : 0;
}

/// Numbers of a TIFF file's byte order, and the sizes that differ in BigTIFF.
struct Dialect {
  bool big_endian, big_tiff;

  int offset_size() const { return big_tiff ? 8 : 4; }
  int count_size() const { return big_tiff ? 8 : 2; }
  std::uint64_t entry_size() const { return big_tiff ? 20 : 12; }
  std::uint64_t header_size() const { return big_tiff ? 16 : 8; }

  std::uint64_t number(std::string_view bytes, std::uint64_t at, int length) const {
    ByteReader in{bytes, big_endian};
    return in.number(at, length);
  }
  void append(std::string& out, std::uint64_t value, int length) const {
    for (int i = 0; i < length; ++i)
      out.push_back(static_cast<char>(value >> 8 * (big_endian ? length - 1 - i : i)));
  }
};

struct Entry {
  std::uint64_t tag = 0, type = 0, count = 0;
  std::string value;  ///< its bytes, wherever they lay
};

std::optional<Entry> read_entry(const ReadAt& read, const Dialect& dialect, std::string_view bytes) {
  Entry entry{dialect.number(bytes, 0, 2),
              dialect.number(bytes, 2, 2),
              dialect.number(bytes, 4, dialect.offset_size()),
              {}};
  const std::uint64_t size = bytes_of_type(entry.type);
  if (size == 0 || entry.count > kMaxPageBytes / size) return std::nullopt;
  const auto inside = static_cast<std::uint64_t>(dialect.offset_size());
  const std::uint64_t value_at = 4 + inside, length = size * entry.count;
  if (length <= inside)
    entry.value = bytes.substr(value_at, length);
  else
    entry.value = read(dialect.number(bytes, value_at, dialect.offset_size()), length);
  if (entry.value.size() != length) return std::nullopt;
  return entry;
}

/// The directory's entries in its order, as far as decoding needs them; empty where one is not all there.
std::vector<Entry> read_entries(const ReadAt& read, const Dialect& dialect, std::uint64_t directory) {
  const auto count_size = static_cast<std::uint64_t>(dialect.count_size());
  const std::uint64_t count = dialect.number(read(directory, count_size), 0, dialect.count_size());
  if (count == 0 || count > kMaxEntries) return {};
  const std::string bytes = read(directory + count_size, count * dialect.entry_size());
  if (bytes.size() != count * dialect.entry_size()) return {};
  std::vector<Entry> entries;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::string_view part =
        std::string_view(bytes).substr(i * dialect.entry_size(), dialect.entry_size());
    if (!decoding_needs(dialect.number(part, 0, 2))) continue;
    auto entry = read_entry(read, dialect, part);
    if (!entry) return {};
    entries.push_back(std::move(*entry));
  }
  return entries;
}

Entry* find(std::vector<Entry>& entries, TiffTag tag) {
  const auto found =
      std::find_if(entries.begin(), entries.end(), [tag](const Entry& e) { return e.tag == tag; });
  return found == entries.end() ? nullptr : &*found;
}

/// Takes the strips or tiles over to the end of `pixels`, which will stand right behind the header; false
/// where they are not all in the file.
bool take_pixels(const ReadAt& read, const Dialect& dialect, std::vector<Entry>& entries, TiffTag offsets_tag,
                 TiffTag counts_tag, std::string& pixels) {
  Entry *offsets = find(entries, offsets_tag), *counts = find(entries, counts_tag);
  if (offsets == nullptr && counts == nullptr) return true;
  if (offsets == nullptr || counts == nullptr || offsets->count != counts->count) return false;
  const auto offset_size = static_cast<int>(bytes_of_type(offsets->type)),
             count_size = static_cast<int>(bytes_of_type(counts->type));
  std::string moved;
  for (std::uint64_t i = 0; i < offsets->count; ++i) {
    const std::uint64_t length =
        dialect.number(counts->value, i * static_cast<std::uint64_t>(count_size), count_size);
    if (length > kMaxPageBytes - pixels.size()) return false;
    const std::string strip = read(
        dialect.number(offsets->value, i * static_cast<std::uint64_t>(offset_size), offset_size), length);
    if (strip.size() != length) return false;
    dialect.append(moved, dialect.header_size() + pixels.size(), dialect.offset_size());
    pixels += strip;
  }
  offsets->type = dialect.big_tiff ? 16 : 4;
  offsets->value = moved;
  return true;
}

/// Directory and behind it the values that do not fit into it, to stand at this offset.
std::string directory_text(const Dialect& dialect, const std::vector<Entry>& entries,
                           std::uint64_t directory_at) {
  const auto inside = static_cast<std::size_t>(dialect.offset_size());
  const std::uint64_t size =
      static_cast<std::uint64_t>(dialect.count_size()) + entries.size() * dialect.entry_size() + inside;
  std::string directory, values;
  dialect.append(directory, entries.size(), dialect.count_size());
  for (const Entry& entry : entries) {
    dialect.append(directory, entry.tag, 2);
    dialect.append(directory, entry.type, 2);
    dialect.append(directory, entry.count, dialect.offset_size());
    if (entry.value.size() <= inside) {
      directory += entry.value + std::string(inside - entry.value.size(), '\0');
    } else {
      dialect.append(directory, directory_at + size + values.size(), dialect.offset_size());
      values += entry.value;
      if (values.size() % 2 != 0) values.push_back('\0');
    }
  }
  dialect.append(directory, 0, dialect.offset_size());  // no further page
  return directory + values;
}

}  // namespace

TiffLayout read_tiff_layout(const ReadAt& read, std::uint64_t file_size) {
  const std::string head = read(0, 16);
  TiffLayout layout;
  layout.big_endian = head.substr(0, 2) == "MM";
  const Dialect probe{layout.big_endian, false};
  const std::uint64_t magic = probe.number(head, 2, 2);
  layout.is_tiff = (layout.big_endian || head.substr(0, 2) == "II") && (magic == 42 || magic == 43);
  if (!layout.is_tiff) return layout;
  layout.big_tiff = magic == 43;
  layout.file_size = file_size;
  const Dialect dialect{layout.big_endian, layout.big_tiff};
  std::uint64_t at = dialect.number(head, layout.big_tiff ? 8 : 4, dialect.offset_size());
  std::uint64_t met_before = 0;  // of the last power of two (Brent): finds every loop
  for (std::size_t count = 1; at != 0 && at != met_before; ++count) {
    if ((count & (count - 1)) == 0) met_before = at;
    layout.pages.push_back(at);
    const auto count_size = static_cast<std::uint64_t>(dialect.count_size());
    const std::string entries = at < file_size ? read(at, count_size) : "";
    const std::uint64_t number = dialect.number(entries, 0, dialect.count_size());
    if (entries.size() != count_size || number > kMaxEntries) break;
    const std::string next = read(at + count_size + number * dialect.entry_size(),
                                  static_cast<std::uint64_t>(dialect.offset_size()));
    at = dialect.number(next, 0, dialect.offset_size());
  }
  return layout;
}

std::string cut_tiff_page(const ReadAt& read, const TiffLayout& layout, std::uint64_t directory) {
  const Dialect dialect{layout.big_endian, layout.big_tiff};
  if (directory >= layout.file_size) return {};
  std::vector<Entry> entries = read_entries(read, dialect, directory);
  std::string pixels;
  const bool whole = !entries.empty() &&
                     take_pixels(read, dialect, entries, kTiffStripOffsets, kTiffStripByteCounts, pixels) &&
                     take_pixels(read, dialect, entries, kTiffTileOffsets, kTiffTileByteCounts, pixels);
  if (!whole) return {};
  if (pixels.size() % 2 != 0) pixels.push_back('\0');
  const std::uint64_t directory_at = dialect.header_size() + pixels.size();
  std::string page = layout.big_endian ? "MM" : "II";
  dialect.append(page, layout.big_tiff ? 43 : 42, 2);
  for (const std::uint64_t constant : {std::uint64_t{8}, std::uint64_t{0}})  // size of an offset, always 0
    if (layout.big_tiff) dialect.append(page, constant, 2);
  dialect.append(page, directory_at, dialect.offset_size());
  return page + pixels + directory_text(dialect, entries, directory_at);
}

}  // namespace lightstripe
