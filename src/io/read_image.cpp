// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A picture file -> grey values.
#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/grey_channel.h"
#include "io/image_header.h"
#include "io/images.h"

namespace lightstripe {
namespace {

constexpr std::int64_t kMaxPixels = std::int64_t{1} << 28;
constexpr const char* kExportAgain = "record or export it again";

void check_header(const ImageHeader& header, const std::filesystem::path& path) {
  const std::string file = path.string();
  if (header.format == ImageFormat::kUnknown)
    throw Error(file, "is not a PNG, JPEG, TIFF, BMP or PNM picture", "check the path or convert it");
  if (header.width < 0 || header.height < 0 || header.width > kMaxPixels || header.height > kMaxPixels ||
      header.width * header.height > kMaxPixels) {
    throw Error(file, fmt::format("has {} x {} pixels, more than 2^28", header.width, header.height),
                "check the file or cut the picture");
  }
  if (!header.damage.empty()) throw Error(file, header.damage, kExportAgain);
  if (header.width == 0 || header.height == 0) throw Error(file, "has no pixels", kExportAgain);
}

/// Grey or BGR, 8 or 16 bits, alpha dropped, not turned by EXIF.
cv::Mat decoded(const std::string& bytes, const std::filesystem::path& path) {
  cv::Mat picture;
  try {
    const cv::Mat buffer(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data()));
    picture = cv::imdecode(buffer, cv::IMREAD_ANYDEPTH | cv::IMREAD_ANYCOLOR | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception&) {
    picture.release();
  }
  if (picture.empty()) throw Error(path.string(), "cannot be decoded, its content is damaged", kExportAgain);
  if (picture.depth() != CV_8U && picture.depth() != CV_16U)
    throw Error(path.string(), "has neither 8 nor 16 bits a channel", "convert it to 8 or 16 bits");
  return picture;
}

cv::Mat with_8_bits(const cv::Mat& picture, int white) {
  if (picture.depth() == CV_8U) return picture;
  cv::Mat scaled;
  picture.convertTo(scaled, CV_8U, 255.0 / white);
  return scaled;
}

}  // namespace

Image8 read_image(const std::filesystem::path& path, Channel channel) {
  return read_image(path, channel, nullptr);
}

Image8 read_image(const std::filesystem::path& path, Channel channel, Channel* chosen) {
  const std::string bytes = read_file(path);
  if (bytes.empty()) throw Error(path.string(), "is empty", kExportAgain);
  const ImageHeader header = inspect_image(bytes);
  check_header(header, path);
  const cv::Mat picture =
      with_8_bits(decoded(bytes, path), header.max_value > 255 ? header.max_value : 65535);
  if (picture.cols != header.width || picture.rows != header.height)
    throw Error(path.string(), "cannot be decoded as its header says", kExportAgain);
  if (channel == Channel::kAuto) channel = strongest_channel(picture).channel;
  if (chosen != nullptr) *chosen = channel;
  return grey_values(picture, channel, path.string());
}

}  // namespace lightstripe
