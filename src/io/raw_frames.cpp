// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/raw_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>
#include <vector>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/frame_numbers.h"
#include "io/frames_ahead.h"
#include "io/live_source.h"
#include "io/plain_pixels.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kRaw = "raw:";
constexpr const char* kExample = "write raw:PATTERN?width=960&height=700";

struct RawLayout {
  int width = 0, height = 0, bytes_a_pixel = 1;
  std::uint64_t skip = 0;
  std::uint64_t frame_bytes() const {
    return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) *
           static_cast<std::uint64_t>(bytes_a_pixel);
  }
};

double whole_number(const SourceText& text, const std::string& key, double least, double most) {
  const double number = *number_option(text, key);
  if (number != std::floor(number) || number < least || number > most)
    throw Error(fmt::format("option {} of {}", key, text.place), fmt::format("is {}", number),
                fmt::format("give a whole number from {} to {}", least, most));
  return number;
}

RawLayout layout_of(const SourceText& text) {
  constexpr double kMostSide = 1 << 14, kMostSkip = 1 << 30;
  refuse_other_options(text, {"width", "height", "bits", "skip", "frame_rate"});
  for (const char* side : {"width", "height"})
    if (!text.options.contains(side))
      throw Error(text.place, fmt::format("does not say the {} of its frames", side), kExample);
  RawLayout layout;
  layout.width = static_cast<int>(whole_number(text, "width", 1, kMostSide));
  layout.height = static_cast<int>(whole_number(text, "height", 1, kMostSide));
  if (text.options.contains("skip"))
    layout.skip = static_cast<std::uint64_t>(whole_number(text, "skip", 0, kMostSkip));
  const auto bits = text.options.find("bits");
  if (bits != text.options.end() && bits->second != "8" && bits->second != "16")
    throw Error("option bits of " + text.place, "is " + bits->second, "unpack the frames to 8 or 16 bits");
  layout.bytes_a_pixel = bits != text.options.end() && bits->second == "16" ? 2 : 1;
  return layout;
}

class RawFrames : public FrameSource {
 public:
  RawFrames(FileNames files, const RawLayout& layout)
      : folder_(std::move(files.folder)), names_(std::move(files.names)), layout_(layout) {
    begins_.reserve(names_.size() + 1);
    for (const std::string& name : names_) begins_.push_back(begins_.back() + frames_in(folder_ / name));
    if (one_a_file()) numbers_ = numbers_in_names(names_);
  }

  std::int64_t size() const override { return begins_.back(); }
  std::string name(std::int64_t index) const override {
    const auto [file, frame] = place_of(index);
    return one_a_file() ? names_[file] : fmt::format("{}#{}", names_[file], frame);
  }
  fs::path file(std::int64_t index) const override { return folder_ / names_[place_of(index).first]; }
  GreyImage read(std::int64_t index) const override {
    if (layout_.bytes_a_pixel == 1) return look(index).image();
    const auto file = mapped(place_of(index).first);
    return wide_image(pixels_of(*file, index));
  }
  Picture look(std::int64_t index) const override {
    if (layout_.bytes_a_pixel != 1) return read(index);
    auto file = mapped(place_of(index).first);
    const std::string_view bytes = pixels_of(*file, index);
    const bool cached = file->is_cached(bytes);
    const FramesAhead::Range next = ahead_.after(index, cached);
    for (std::int64_t k = next.begin; k < std::min(size(), next.end); ++k) ask_for(k, *file, index);
    const auto* pixels = reinterpret_cast<const std::uint8_t*>(bytes.data());
    return {ImageView8{pixels, layout_.width, layout_.height, layout_.width}, std::move(file), cached};
  }
  std::optional<std::int64_t> number(std::int64_t index) const override {
    if (numbers_.empty()) return std::nullopt;
    return numbers_[place_of(index).first];
  }

 private:
  /// Whole frames, and one for what is left.
  std::int64_t frames_in(const fs::path& path) const {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(path, error);
    if (error || size <= layout_.skip) return 1;  // told when its turn comes
    return static_cast<std::int64_t>((size - layout_.skip + layout_.frame_bytes() - 1) /
                                     layout_.frame_bytes());
  }
  bool one_a_file() const { return size() == static_cast<std::int64_t>(names_.size()); }

  /// Its file, and its place there.
  std::pair<std::size_t, std::int64_t> place_of(std::int64_t index) const {
    LIGHTSTRIPE_CHECK(index >= 0 && index < size(), "a frame of the sequence");
    const auto next = std::upper_bound(begins_.begin(), begins_.end(), index);
    return {static_cast<std::size_t>(next - begins_.begin() - 1), index - *(next - 1)};
  }

  /// The last file stays mapped, since frames are asked for in order.
  std::shared_ptr<const MappedFile> mapped(std::size_t file) const {
    const std::lock_guard lock(last_mutex_);
    if (last_ && last_file_ == file) return last_;
    const fs::path path = folder_ / names_[file];
    auto opened = MappedFile::open(path);
    if (!opened) throw Error(path.string(), "is empty or cannot be read", "check it and its permissions");
    last_ = opened;
    last_file_ = file;
    return opened;
  }

  /// Asks for frame `k`, which lies in `file` as frame `index` does, or in a file of its own.
  void ask_for(std::int64_t k, const MappedFile& file, std::int64_t index) const {
    const auto [of, frame] = place_of(k);
    if (of == place_of(index).first)
      file.read_ahead(begin_of(frame), layout_.frame_bytes());
    else if (one_a_file())
      read_ahead(folder_ / names_[of]);
  }

  /// Of a frame in its file.
  std::uint64_t begin_of(std::int64_t frame) const {
    return layout_.skip + static_cast<std::uint64_t>(frame) * layout_.frame_bytes();
  }

  std::string_view pixels_of(const MappedFile& file, std::int64_t index) const {
    const std::uint64_t begin = begin_of(place_of(index).second);
    const std::uint64_t size = file.bytes().size();
    if (begin > size || size - begin < layout_.frame_bytes())
      throw Error((folder_ / name(index)).string(),
                  fmt::format("has {} bytes, a frame of {} x {} has {}", size > begin ? size - begin : 0,
                              layout_.width, layout_.height, layout_.frame_bytes()),
                  "record it again, or mend width, height, bits or skip");
    return file.bytes().substr(begin, layout_.frame_bytes());
  }

  Image16 wide_image(std::string_view bytes) const {
    Image16 image(layout_.width, layout_.height);
    for (std::size_t k = 0; k < image.pixels.size(); ++k)
      image.pixels[k] = static_cast<std::uint16_t>(static_cast<unsigned char>(bytes[2 * k]) |
                                                   (static_cast<unsigned char>(bytes[2 * k + 1]) << 8));
    return image;
  }

  fs::path folder_;
  std::vector<std::string> names_;
  RawLayout layout_;
  std::vector<std::int64_t> begins_{0};  ///< of each file's frames, and their number
  std::vector<std::int64_t> numbers_;
  mutable FramesAhead ahead_;
  mutable std::mutex last_mutex_;
  mutable std::shared_ptr<const MappedFile> last_;
  mutable std::size_t last_file_ = 0;
};

}  // namespace

bool is_raw(const std::string& frames) { return frames.starts_with(kRaw); }

std::string files_of_frames(const std::string& frames) {
  return is_raw(frames) ? parse_source(frames).place.substr(kRaw.size()) : frames;
}

std::unique_ptr<FrameSource> open_raw_frames(const fs::path& base, const std::string& frames) {
  const RawLayout layout = layout_of(parse_source(frames));
  FileNames files = list_file_names(base, files_of_frames(frames));
  refuse_special_file(files.folder / files.names.front());
  return std::make_unique<RawFrames>(std::move(files), layout);
}

}  // namespace lightstripe
