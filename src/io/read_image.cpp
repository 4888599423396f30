// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A picture file -> grey values.
#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/decode_picture.h"
#include "io/decode_tiff.h"
#include "io/grey_channel.h"
#include "io/image_header.h"
#include "io/images.h"
#include "io/opencv_codecs.h"
#include "io/png_grey.h"

namespace lightstripe {
namespace {

void check_header(const ImageHeader& header, const std::string& name) {
  if (header.format == ImageFormat::kUnknown)
    throw Error(name, "is not a PNG, JPEG, TIFF, BMP or PNM picture", "check the path or convert it");
  if (header.width < 0 || header.height < 0 || header.width > kMaxPixels || header.height > kMaxPixels ||
      header.width * header.height > kMaxPixels) {
    throw Error(name, fmt::format("has {} x {} pixels, more than 2^28", header.width, header.height),
                "check the file or cut the picture");
  }
  if (!header.damage.empty()) throw Error(name, header.damage, kExportAgain);
  if (header.width == 0 || header.height == 0) throw Error(name, "has no pixels", kExportAgain);
}

/// Grey or BGR, 8 or 16 bits, alpha dropped, not turned by EXIF or TIFF's Orientation. A white that the file
/// tells goes into the header.
cv::Mat decoded(std::string_view bytes, const std::string& name, ImageHeader& header) {
  if (header.format == ImageFormat::kTiff) {
    TiffPicture tiff = decode_tiff(bytes, name);
    header.max_value = tiff.white;
    return std::move(tiff.pixels);
  }
  const cv::Mat buffer(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data()));
  cv::Mat picture = opencv_codecs().decode(buffer);
  if (picture.empty()) throw Error(name, "cannot be decoded, its content is damaged", kExportAgain);
  if (picture.depth() != CV_8U && picture.depth() != CV_16U)
    throw Error(name, "has neither 8 nor 16 bits a channel", "convert it to 8 or 16 bits");
  return picture;
}

/// White is what the header says, else what the fewest of a camera's usual bits can hold.
cv::Mat scaled_to_8_bits(const cv::Mat& picture, const ImageHeader& header) {
  double white = header.max_value;
  if (header.max_value <= 255) {
    double largest = 0;
    cv::minMaxLoc(picture.reshape(1), nullptr, &largest);
    white = largest <= 1023 ? 1023 : largest <= 4095 ? 4095 : largest <= 16383 ? 16383 : 65535;
  }
  cv::Mat scaled;
  picture.convertTo(scaled, CV_8U, 255.0 / white);
  return scaled;
}

/// Binary grey PNM with a white of 255: the pixels lie in the file as they are needed.
Image8 grey_pnm(std::string_view bytes, const ImageHeader& header) {
  const auto count = static_cast<std::size_t>(header.width * header.height);
  Image8 image;
  image.width = static_cast<int>(header.width);
  image.height = static_cast<int>(header.height);
  const auto* first = reinterpret_cast<const std::uint8_t*>(bytes.data() + header.payload_at);
  image.pixels.assign(first, first + count);
  return image;
}

/// The kinds that long recordings consist of, without OpenCV's detour; nothing for all others.
std::optional<GreyImage> plain_picture(std::string_view bytes, const ImageHeader& header, Bits bits) {
  if (header.format == ImageFormat::kPnm && header.max_value == 255 && bytes[1] == '5')
    return grey_pnm(bytes, header);
  if (header.format != ImageFormat::kPng) return std::nullopt;
  auto picture = decode_grey_png(bytes);
  if (picture && bits == Bits::kReducedTo8 && std::holds_alternative<Image16>(*picture)) return std::nullopt;
  return picture;
}

}  // namespace

GreyImage decode_picture(std::string_view bytes, const std::string& name, Channel channel, Bits bits,
                         Channel* chosen) {
  if (bytes.empty()) throw Error(name, "is empty", kExportAgain);
  ImageHeader header = inspect_image(bytes);
  check_header(header, name);
  if (auto plain = plain_picture(bytes, header, bits)) {
    if (channel == Channel::kAuto) channel = Channel::kGray;
    check_grey_channel(channel, name);
    if (chosen != nullptr) *chosen = channel;
    return std::move(*plain);
  }
  cv::Mat picture = decoded(bytes, name, header);
  if (picture.cols != header.width || picture.rows != header.height)
    throw Error(name, "cannot be decoded as its header says", kExportAgain);
  const bool wide = bits == Bits::kKept && picture.type() == CV_16UC1;
  if (picture.depth() == CV_16U && !wide) picture = scaled_to_8_bits(picture, header);
  if (channel == Channel::kAuto) channel = strongest_channel(picture).channel;
  if (chosen != nullptr) *chosen = channel;
  if (!wide) return grey_values(picture, channel, name);
  check_grey_channel(channel, name);
  return image16_of(picture);
}

Image8 read_image(const std::filesystem::path& path, Channel channel) {
  return read_image(path, channel, nullptr);
}

Image8 read_image(const std::filesystem::path& path, Channel channel, Channel* chosen) {
  return std::get<Image8>(decode_picture(read_file(path), path.string(), channel, Bits::kReducedTo8, chosen));
}

GreyImage read_grey_image(const std::filesystem::path& path, Channel channel, Channel* chosen) {
  return decode_picture(read_file(path), path.string(), channel, Bits::kKept, chosen);
}

RgbImage read_rgb_image(const std::filesystem::path& path) {
  const std::string bytes = read_file(path), name = path.string();
  if (bytes.empty()) throw Error(name, "is empty", kExportAgain);
  ImageHeader header = inspect_image(bytes);
  check_header(header, name);
  cv::Mat picture = decoded(bytes, name, header);
  if (picture.depth() == CV_16U) picture = scaled_to_8_bits(picture, header);
  cv::cvtColor(picture, picture, picture.channels() == 1 ? cv::COLOR_GRAY2RGB : cv::COLOR_BGR2RGB);
  const auto* first = picture.ptr<std::uint8_t>();
  return {{first, first + picture.total() * 3}, picture.cols, picture.rows};
}

}  // namespace lightstripe
