// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/tiff_pages.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "core/error.h"
#include "io/choose_channel.h"
#include "io/decode_picture.h"
#include "io/frames_ahead.h"
#include "io/plain_pixels.h"
#include "io/tiff_page_cut.h"

namespace lightstripe {
namespace {

/// A file that several threads read at once.
class SharedFile {
 public:
  explicit SharedFile(const std::filesystem::path& path)
      : number_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (number_ < 0) throw Error(path.string(), "cannot be read", "check the path and its permissions");
  }
  ~SharedFile() { ::close(number_); }
  SharedFile(const SharedFile&) = delete;
  SharedFile& operator=(const SharedFile&) = delete;

  std::uint64_t size() const { return static_cast<std::uint64_t>(::lseek(number_, 0, SEEK_END)); }
  std::string read(std::uint64_t offset, std::uint64_t length) const {
    if (offset > size() || length > size() - offset) return {};  // before anything is allocated
    std::string bytes(length, '\0');
    for (std::size_t got = 0; got < bytes.size();) {
      const ssize_t more =
          ::pread(number_, bytes.data() + got, bytes.size() - got, static_cast<off_t>(offset + got));
      if (more <= 0) return {};
      got += static_cast<std::size_t>(more);
    }
    return bytes;
  }

 private:
  int number_;
};

class TiffPages : public FrameSource {
 public:
  explicit TiffPages(const std::filesystem::path& path)
      : path_(path), file_(path), layout_(read_tiff_layout(reader(), file_.size())) {}

  void decide(Channel channel) {
    channel_ =
        channel != Channel::kAuto ? channel : decide_channel(size(), [this](std::int64_t i, Channel* chosen) {
          read_as(i, Channel::kAuto, chosen);
        });
  }

  std::int64_t size() const override { return static_cast<std::int64_t>(layout_.pages.size()); }
  std::string name(std::int64_t index) const override {
    return fmt::format("{}#{}", path_.filename().string(), index);
  }
  std::filesystem::path file(std::int64_t) const override { return path_; }
  Channel channel() const override { return channel_; }
  GreyImage read(std::int64_t index) const override { return read_as(index, channel_, nullptr); }
  Picture look(std::int64_t index) const override {
    LIGHTSTRIPE_CHECK(index >= 0 && index < size(), "a frame of the sequence");
    const auto pixels =
        mapped_ && !is_excess(channel_)
            ? find_tiff_pixels(mapped_->bytes(), layout_.pages[static_cast<std::size_t>(index)])
            : std::nullopt;
    if (!pixels) return read(index);
    const std::string_view bytes(
        reinterpret_cast<const char*>(pixels->data),
        static_cast<std::size_t>(pixels->width) * static_cast<std::size_t>(pixels->height));
    const bool cached = mapped_->is_cached(bytes);
    const FramesAhead::Range next = ahead_.after(index, cached);
    for (std::int64_t k = next.begin; k < std::min(size(), next.end); ++k)
      mapped_->read_ahead(layout_.pages[static_cast<std::size_t>(k)], bytes.size());
    return {*pixels, mapped_, cached};
  }

 private:
  ReadAt reader() const {
    return [this](std::uint64_t offset, std::uint64_t length) { return file_.read(offset, length); };
  }

  GreyImage read_as(std::int64_t index, Channel channel, Channel* chosen) const {
    LIGHTSTRIPE_CHECK(index >= 0 && index < size(), "a frame of the sequence");
    const std::string page = cut_tiff_page(reader(), layout_, layout_.pages[static_cast<std::size_t>(index)]);
    const std::string called = fmt::format("{}#{}", path_.string(), index);
    if (page.empty()) throw Error(called, "ends before this page does", "record or export it again");
    return decode_picture(page, called, channel, Bits::kKept, chosen);
  }

  std::filesystem::path path_;
  SharedFile file_;
  TiffLayout layout_;
  std::shared_ptr<const MappedFile> mapped_ = MappedFile::open(path_);
  Channel channel_ = Channel::kGray;
  mutable FramesAhead ahead_;
};

}  // namespace

std::unique_ptr<FrameSource> open_tiff_pages(const std::filesystem::path& path, Channel channel) {
  auto pages = std::make_unique<TiffPages>(path);
  if (pages->size() < 2) return nullptr;
  pages->decide(channel);
  return pages;
}

}  // namespace lightstripe
