// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Recorded sequences: a folder of pictures or a video file.
#include <fmt/format.h>
#include <algorithm>
#include <array>

#include "core/error.h"
#include "io/images.h"
#include "io/video_frames.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kSamples = 8;  // pictures looked at to decide the channel

bool is_picture_name(const fs::path& path) {
  constexpr std::array<std::string_view, 9> kExtensions = {".png", ".jpg", ".jpeg", ".tif", ".tiff",
                                                           ".bmp", ".pgm", ".ppm",  ".pnm"};
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

/// The first picture of up to kSamples, spread over the sequence, that shows a colour decides: the line may
/// not be there yet at the start of a scan.
Channel decided_channel(const std::vector<fs::path>& files) {
  const std::size_t count = std::min(kSamples, files.size());
  for (std::size_t i = 0; i < count; ++i) {
    Channel chosen = Channel::kGray;
    read_image(files[i * files.size() / count], Channel::kAuto, &chosen);
    if (chosen != Channel::kGray) return chosen;
  }
  return Channel::kGray;
}

class ImageFolder : public FrameSource {
 public:
  ImageFolder(std::vector<fs::path> files, Channel channel)
      : files_(std::move(files)), channel_(channel == Channel::kAuto ? decided_channel(files_) : channel) {
    const Image8 first = read_image(files_.front(), channel_);
    width_ = first.width;
    height_ = first.height;
  }

  std::int64_t size() const override { return static_cast<std::int64_t>(files_.size()); }
  std::string name(std::int64_t index) const override { return file(index).filename().string(); }
  Image8 read(std::int64_t index) const override {
    Image8 image = read_image(file(index), channel_);
    if (image.width == width_ && image.height == height_) return image;
    throw Error(file(index).string(),
                fmt::format("has {} x {} pixels, but the first frame {} has {} x {}", image.width,
                            image.height, files_.front().filename().string(), width_, height_),
                "keep frames of one camera in a folder of their own");
  }

 private:
  const fs::path& file(std::int64_t index) const {
    LIGHTSTRIPE_CHECK(index >= 0 && index < size(), "a frame of the sequence");
    return files_[static_cast<std::size_t>(index)];
  }

  std::vector<fs::path> files_;
  Channel channel_;
  int width_ = 0, height_ = 0;
};

}  // namespace

std::unique_ptr<FrameSource> open_frames(const fs::path& base, const std::string& pattern, Channel channel) {
  std::vector<fs::path> files = list_files(base, pattern);
  const bool is_video = pattern.find_first_of("*?") == std::string::npos && !is_picture_name(files.front());
  if (is_video) return open_video(files.front(), channel);
  return std::make_unique<ImageFolder>(std::move(files), channel);
}

}  // namespace lightstripe
