// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/growing_tiff.h"

#include <fcntl.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <cstring>
#include <vector>

#include "core/error.h"
#include "io/atomic_file.h"

namespace lightstripe {
namespace {

static_assert(std::endian::native == std::endian::little, "the file is written in the machine's byte order");

enum Type : std::uint16_t { kShort = 3, kLong = 4, kLong8 = 16 };

/// A BigTIFF directory as it grows.
struct Directory {
  std::vector<unsigned char> bytes;
  std::uint64_t entries = 0;

  template <class T>
  void put(T value) {
    const auto* first = reinterpret_cast<const unsigned char*>(&value);
    bytes.insert(bytes.end(), first, first + sizeof(T));
  }
  void entry(std::uint16_t tag, Type type, std::uint64_t value) {
    put(tag);
    put(static_cast<std::uint16_t>(type));
    put(std::uint64_t{1});
    put(value);  // short numbers stand first in the eight bytes
    ++entries;
  }
};

/// Of a page of one strip at `pixels`.
Directory directory_of(int width, int height, int bits, std::uint64_t pixels, std::uint64_t count) {
  Directory d;
  d.put(std::uint64_t{0});  // how many entries: put in at the end
  d.entry(256, kLong, static_cast<std::uint64_t>(width));
  d.entry(257, kLong, static_cast<std::uint64_t>(height));
  d.entry(258, kShort, static_cast<std::uint64_t>(bits));
  d.entry(259, kShort, 1);  // no compression
  d.entry(262, kShort, 1);  // black is 0
  d.entry(273, kLong8, pixels);
  d.entry(277, kShort, 1);
  d.entry(278, kLong, static_cast<std::uint64_t>(height));
  d.entry(279, kLong8, count);
  d.put(std::uint64_t{0});  // no page behind this one yet
  std::memcpy(d.bytes.data(), &d.entries, sizeof(d.entries));
  return d;
}

}  // namespace

GrowingTiff::GrowingTiff(const std::filesystem::path& path) : path_(path) {
  descriptor_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor_ < 0 && errno == EEXIST)
    throw Error(path.string(), "is there already", "name another file, or remove it");
  if (descriptor_ < 0) cannot_write(path, errno);
  const unsigned char head[16] = {'I', 'I', 43, 0, 8, 0, 0, 0};  // the first page's place is not known yet
  write_at(0, head, sizeof(head));
}

GrowingTiff::~GrowingTiff() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void GrowingTiff::write_at(std::uint64_t offset, const void* bytes, std::size_t count) {
  const auto* next = static_cast<const char*>(bytes);
  while (count > 0) {
    const ssize_t written = ::pwrite(descriptor_, next, count, static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) cannot_write(path_, written < 0 ? errno : EIO);
    next += written;
    offset += static_cast<std::uint64_t>(written);
    count -= static_cast<std::size_t>(written);
  }
}

void GrowingTiff::append(const GreyImage& image) {
  std::visit(
      [&](const auto& picture) {
        const std::uint64_t count = picture.pixels.size() * sizeof(picture.pixels[0]);
        const Directory d = directory_of(picture.width, picture.height,
                                         8 * static_cast<int>(sizeof(picture.pixels[0])), end_, count);
        const std::uint64_t directory = (end_ + count + 7) / 8 * 8;
        write_at(end_, picture.pixels.data(), count);
        write_at(directory, d.bytes.data(), d.bytes.size());
        write_at(link_, &directory, sizeof(directory));
        end_ = directory + d.bytes.size();
        link_ = end_ - sizeof(std::uint64_t);
      },
      image);
  ++pages_;
}

}  // namespace lightstripe
