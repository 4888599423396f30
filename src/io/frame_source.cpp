// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Recorded sequences: a folder of pictures, a multi-page TIFF, frames without a header or a video file.
#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <utility>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/choose_channel.h"
#include "io/frame_numbers.h"
#include "io/frames_ahead.h"
#include "io/images.h"
#include "io/plain_pixels.h"
#include "io/raw_frames.h"
#include "io/tiff_pages.h"
#include "io/video_frames.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

std::string small_extension(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return extension;
}

bool is_tiff_name(const fs::path& path) {
  const std::string extension = small_extension(path);
  return extension == ".tif" || extension == ".tiff";
}

bool is_picture_name(const fs::path& path) {
  constexpr std::array<std::string_view, 7> kExtensions = {".png", ".jpg", ".jpeg", ".bmp",
                                                           ".pgm", ".ppm", ".pnm"};
  const std::string extension = small_extension(path);
  return is_tiff_name(path) ||
         std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

/// All pictures of a folder; its tables and notes are left alone.
FileNames pictures_in(const fs::path& base, const std::string& folder) {
  FileNames files = list_file_names(base, (fs::path(folder) / "*").string());
  std::erase_if(files.names, [](const std::string& name) { return !is_picture_name(name); });
  if (files.names.empty())
    throw Error((base / folder).string(), "holds no pictures (.png .jpg .bmp .pgm .tif)", "check the folder");
  return files;
}

/// Keeps names, not paths: a long recording has very many.
class ImageFolder : public FrameSource {
 public:
  ImageFolder(FileNames files, Channel channel)
      : folder_(std::move(files.folder)), names_(std::move(files.names)) {
    numbers_ = numbers_in_names(names_);
    channel_ =
        channel != Channel::kAuto ? channel : decide_channel(size(), [this](std::int64_t i, Channel* chosen) {
          read_grey_image(folder_ / names_[static_cast<std::size_t>(i)], Channel::kAuto, chosen);
        });
  }

  std::int64_t size() const override { return static_cast<std::int64_t>(names_.size()); }
  std::string name(std::int64_t index) const override { return names_[checked(index)]; }
  fs::path file(std::int64_t index) const override { return folder_ / names_[checked(index)]; }
  GreyImage read(std::int64_t index) const override {
    return read_grey_image(folder_ / names_[checked(index)], channel_);
  }
  Channel channel() const override { return channel_; }
  Picture look(std::int64_t index) const override {
    auto picture = map_picture(file(index), channel_);
    if (!picture) return read(index);
    const FramesAhead::Range next = ahead_.after(index, picture->is_cached());
    for (std::int64_t k = next.begin; k < std::min(size(), next.end); ++k) read_ahead(file(k));
    return *std::move(picture);
  }
  std::optional<std::int64_t> number(std::int64_t index) const override {
    if (numbers_.empty()) return std::nullopt;
    return numbers_[checked(index)];
  }

 private:
  std::size_t checked(std::int64_t index) const {
    LIGHTSTRIPE_CHECK(index >= 0 && index < size(), "a frame of the sequence");
    return static_cast<std::size_t>(index);
  }

  fs::path folder_;
  std::vector<std::string> names_;
  std::vector<std::int64_t> numbers_;
  Channel channel_ = Channel::kAuto;
  mutable FramesAhead ahead_;
};

}  // namespace

Channel decide_channel(std::int64_t count, const std::function<void(std::int64_t, Channel*)>& look) {
  constexpr std::int64_t kSamples = 8;
  const std::int64_t samples = std::min(kSamples, count);
  std::vector<Channel> votes;
  for (std::int64_t i = 0; i < samples; ++i) {
    Channel chosen = Channel::kGray;
    try {
      look(i * count / samples, &chosen);
    } catch (const Error&) {
      continue;  // told when the frame's turn comes
    }
    votes.push_back(chosen);
  }
  return count_votes(votes);
}

Channel count_votes(std::span<const Channel> votes) {
  constexpr std::array<Channel, 3> kPlain = {Channel::kRedLaser, Channel::kGreenLaser, Channel::kBlueLaser},
                                   kClipped = {Channel::kRedClipped, Channel::kGreenClipped,
                                               Channel::kBlueClipped},
                                   kTextured = {Channel::kRedTextured, Channel::kGreenTextured,
                                                Channel::kBlueTextured};
  Channel best = Channel::kGray;
  std::ptrdiff_t most = 0;
  for (std::size_t k = 0; k < kPlain.size(); ++k) {
    const auto plain = std::count(votes.begin(), votes.end(), kPlain.at(k)),
               clipped = std::count(votes.begin(), votes.end(), kClipped.at(k)),
               textured = std::count(votes.begin(), votes.end(), kTextured.at(k));
    if (plain + clipped + textured <= most) continue;
    most = plain + clipped + textured;
    best = 3 * clipped >= most ? kClipped.at(k) : 2 * textured > most ? kTextured.at(k) : kPlain.at(k);
  }
  return best;
}

Channel channel_of_pictures(const std::vector<fs::path>& files) {
  return decide_channel(static_cast<std::int64_t>(files.size()), [&files](std::int64_t i, Channel* chosen) {
    read_image(files[static_cast<std::size_t>(i)], Channel::kAuto, chosen);
  });
}

std::unique_ptr<FrameSource> open_frames(const fs::path& base, const std::string& pattern, Channel channel) {
  std::error_code error;
  if (is_raw(pattern)) {
    if (is_excess(channel))
      throw Error(pattern, "is grey and has no colour excess", "set channel: auto or gray");
    return open_raw_frames(base, pattern);
  }
  if (fs::is_directory(base / pattern, error))
    return std::make_unique<ImageFolder>(pictures_in(base, pattern), channel);
  FileNames files = list_file_names(base, pattern);
  const fs::path first = files.folder / files.names.front();
  refuse_special_file(first);
  const bool one_file = pattern.find_first_of("*?") == std::string::npos;
  if (one_file && is_tiff_name(first)) {
    if (auto pages = open_tiff_pages(first, channel)) return pages;
  }
  if (one_file && !is_picture_name(first)) return open_video(first, channel);
  return std::make_unique<ImageFolder>(std::move(files), channel);
}

}  // namespace lightstripe
