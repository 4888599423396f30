// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/plain_pixels.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <vector>

#include "io/byte_reader.h"
#include "io/image_header.h"
#include "io/tiff_tags.h"

namespace lightstripe {
namespace {

constexpr std::uint64_t kMostSide = 1 << 14, kMostStrips = 1 << 14;

/// Rows of `width` bytes, each `stride` behind the one before; nothing where they are not all there.
std::optional<ImageView8> view_of(std::string_view bytes, std::uint64_t first, std::uint64_t width,
                                  std::uint64_t height, std::uint64_t stride) {
  if (width == 0 || height == 0 || width > kMostSide || height > kMostSide) return std::nullopt;
  const std::uint64_t length = (height - 1) * stride + width;
  if (first > bytes.size() || length > bytes.size() - first) return std::nullopt;
  return ImageView8{reinterpret_cast<const std::uint8_t*>(bytes.data() + first), static_cast<int>(width),
                    static_cast<int>(height), static_cast<std::ptrdiff_t>(stride)};
}

std::optional<ImageView8> pnm_pixels(std::string_view bytes) {
  const ImageHeader header = inspect_image(bytes);
  if (!header.damage.empty() || header.max_value != 255 || header.width <= 0 || header.height <= 0)
    return std::nullopt;
  const auto width = static_cast<std::uint64_t>(header.width);
  return view_of(bytes, header.payload_at, width, static_cast<std::uint64_t>(header.height), width);
}

/// The palette's colour i is the grey value i.
bool is_grey_palette(std::string_view bytes, std::uint64_t at) {
  ByteReader in{bytes};
  for (std::uint64_t i = 0; i < 256; ++i)
    for (std::uint64_t k = 0; k < 3; ++k)
      if (in.u8(at + 4 * i + k) != i) return false;
  return !in.beyond_end;
}

/// Rows of a multiple of four bytes, the lowest one first where the height is positive.
std::optional<ImageView8> bmp_pixels(std::string_view bytes) {
  ByteReader in{bytes};
  const std::uint64_t header_size = in.u32(14), colours = in.u32(46);
  const std::int64_t width = in.i32(18), height = in.i32(22);
  if (header_size < 40 || in.u16(28) != 8 || in.u32(30) != 0 || (colours != 0 && colours != 256) ||
      width <= 0 || height == 0 || !is_grey_palette(bytes, 14 + header_size) || in.beyond_end)
    return std::nullopt;
  const std::uint64_t stride = (static_cast<std::uint64_t>(width) + 3) / 4 * 4;
  auto view = view_of(bytes, in.u32(10), static_cast<std::uint64_t>(width),
                      static_cast<std::uint64_t>(height < 0 ? -height : height), stride);
  if (view && height > 0) {
    view->data = view->row(view->height - 1);
    view->stride = -view->stride;
  }
  return view;
}

/// What a directory says of its picture; 0 where it does not.
struct TiffFacts {
  std::uint64_t width = 0, height = 0, bits = 1, compression = 1, photometric = 0, samples = 1,
                rows_a_strip = UINT32_MAX, fill_order = 1, sample_format = 1;
  bool tiled = false;
  std::vector<std::uint64_t> offsets, counts;
};

class TiffDirectory {
 public:
  TiffDirectory(std::string_view bytes, bool big_endian, bool big_tiff)
      : in_{bytes, big_endian}, big_tiff_(big_tiff), word_(big_tiff ? 8 : 4) {}

  std::optional<TiffFacts> read(std::uint64_t at) {
    const std::uint64_t entries = in_.number(at, big_tiff_ ? 8 : 2), size = big_tiff_ ? 20 : 12;
    if (entries > 1024) return std::nullopt;
    at += big_tiff_ ? 8 : 2;
    TiffFacts facts;
    // Tags rise, says TIFF 6.0; which of two alike counts is the library's to say.
    for (std::uint64_t i = 0, last = 0; i < entries; ++i, at += size) {
      const std::uint64_t tag = in_.u16(at);
      if (tag <= last || !take(at, facts)) return std::nullopt;
      last = tag;
    }
    return in_.beyond_end ? std::nullopt : std::optional(facts);
  }

 private:
  /// The numbers of an entry, shorts or longs.
  std::vector<std::uint64_t> values(std::uint64_t at) {
    const std::uint64_t type = in_.u16(at + 2), count = in_.number(at + 4, word_);
    const int size = type == 3 ? 2 : type == 4 ? 4 : type == 16 ? 8 : 0;
    if (size == 0 || count == 0 || count > kMostStrips) return {};
    std::uint64_t from = at + 4 + static_cast<std::uint64_t>(word_);
    if (count * static_cast<std::uint64_t>(size) > static_cast<std::uint64_t>(word_))
      from = in_.number(from, word_);
    std::vector<std::uint64_t> out;
    for (std::uint64_t i = 0; i < count; ++i)
      out.push_back(in_.number(from + i * static_cast<std::uint64_t>(size), size));
    return out;
  }

  bool take(std::uint64_t at, TiffFacts& facts) {
    const std::uint64_t tag = in_.u16(at);
    const std::array<std::pair<std::uint64_t, std::uint64_t*>, 9> kNumbers = {{{kTiffWidth, &facts.width},
                                                                               {kTiffHeight, &facts.height},
                                                                               {258, &facts.bits},
                                                                               {259, &facts.compression},
                                                                               {262, &facts.photometric},
                                                                               {266, &facts.fill_order},
                                                                               {277, &facts.samples},
                                                                               {278, &facts.rows_a_strip},
                                                                               {339, &facts.sample_format}}};
    if (tag >= kTiffTileWidth && tag <= kTiffTileByteCounts) facts.tiled = true;
    if (tag == kTiffStripOffsets) facts.offsets = values(at);
    if (tag == kTiffStripByteCounts) facts.counts = values(at);
    for (const auto& [number, place] : kNumbers) {
      if (tag != number) continue;
      const auto found = values(at);
      if (found.size() != 1) return false;
      *place = found.front();
    }
    return true;
  }

  ByteReader in_;
  bool big_tiff_;
  int word_;
};

bool is_plain(const TiffFacts& f) {
  constexpr std::uint64_t kBlackIsZero = 1;
  if (f.tiled || f.bits != 8 || f.compression != 1 || f.photometric != kBlackIsZero || f.samples != 1 ||
      f.fill_order != 1 || f.sample_format != 1 || f.offsets.empty() || f.offsets.size() != f.counts.size() ||
      f.rows_a_strip == 0)
    return false;
  for (std::size_t i = 0; i < f.offsets.size(); ++i) {
    const std::uint64_t begin = i * f.rows_a_strip;
    if (begin >= f.height || f.counts[i] != std::min(f.rows_a_strip, f.height - begin) * f.width)
      return false;
    if (i > 0 && f.offsets[i] != f.offsets[i - 1] + f.counts[i - 1]) return false;
  }
  return f.rows_a_strip >= f.height || f.offsets.size() * f.rows_a_strip >= f.height;
}

}  // namespace

std::shared_ptr<const MappedFile> MappedFile::open(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return nullptr;
  struct stat status {};
  const bool regular = ::fstat(file, &status) == 0 && S_ISREG(status.st_mode) && status.st_size > 0;
  const auto size = static_cast<std::size_t>(regular ? status.st_size : 0);
  void* data = regular ? ::mmap(nullptr, size, PROT_READ, MAP_SHARED, file, 0) : MAP_FAILED;
  ::close(file);
  if (data == MAP_FAILED) return nullptr;
  return std::shared_ptr<const MappedFile>(new MappedFile(static_cast<const char*>(data), size));
}

MappedFile::~MappedFile() { ::munmap(const_cast<char*>(data_), size_); }

bool MappedFile::is_cached(std::string_view part) const {
  const auto middle = static_cast<std::uint64_t>(part.data() - data_) + part.size() / 2;
  unsigned char in_memory = 1;
  return ::mincore(page_of(middle), 1, &in_memory) != 0 || (in_memory & 1U) != 0;
}

void MappedFile::read_ahead(std::uint64_t begin, std::uint64_t length) const {
  if (begin >= size_) return;
  char* page = page_of(begin);
  ::madvise(page, static_cast<std::size_t>(data_ + begin - page) + std::min(length, size_ - begin),
            MADV_WILLNEED);
}

char* MappedFile::page_of(std::uint64_t at) const {
  constexpr std::uint64_t kPage = 4096;
  return const_cast<char*>(data_) + at / kPage * kPage;
}

std::optional<ImageView8> find_tiff_pixels(std::string_view bytes, std::uint64_t directory) {
  ByteReader in{bytes, bytes.substr(0, 2) == "MM"};
  const std::uint64_t version = in.u16(2);
  const auto facts = TiffDirectory(bytes, in.big_endian, version == 43).read(directory);
  if (!facts || !is_plain(*facts)) return std::nullopt;
  return view_of(bytes, facts->offsets.front(), facts->width, facts->height, facts->width);
}

std::optional<ImageView8> find_plain_pixels(std::string_view bytes) {
  if (bytes.substr(0, 2) == "P5") return pnm_pixels(bytes);
  if (bytes.substr(0, 2) == "BM") return bmp_pixels(bytes);
  if (bytes.substr(0, 2) != "II" && bytes.substr(0, 2) != "MM") return std::nullopt;
  ByteReader in{bytes, bytes.substr(0, 2) == "MM"};
  const std::uint64_t version = in.u16(2);
  if (version == 42) return find_tiff_pixels(bytes, in.u32(4));
  return version == 43 ? find_tiff_pixels(bytes, in.number(8, 8)) : std::nullopt;
}

std::optional<Picture> map_picture(const std::filesystem::path& path, Channel channel) {
  // An excess of a grey picture is refused by the way that decodes.
  if (is_excess(channel)) return std::nullopt;
  auto file = MappedFile::open(path);
  if (!file) return std::nullopt;
  const auto pixels = find_plain_pixels(file->bytes());
  if (!pixels) return std::nullopt;
  const bool cached = file->is_cached(file->bytes());
  return Picture(*pixels, std::move(file), cached);
}

void read_ahead(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return;
  ::posix_fadvise(file, 0, 0, POSIX_FADV_WILLNEED);
  ::close(file);
}

}  // namespace lightstripe
