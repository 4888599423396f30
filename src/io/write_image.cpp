// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <opencv2/imgproc.hpp>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/images.h"
#include "io/opencv_codecs.h"

namespace lightstripe {
namespace {

void write_mat(const std::filesystem::path& path, const cv::Mat& picture) {
  LIGHTSTRIPE_CHECK(!picture.empty(), "an image to write has pixels");
  std::vector<std::uint8_t> bytes;
  const std::string extension = path.has_extension() ? path.extension().string() : ".png";
  const OpencvCodecs& codecs = opencv_codecs();
  if (!codecs.can_encode(extension) || !codecs.encode(extension, picture, std::nullopt, bytes))
    throw Error(path.string(), "no picture format is known for '" + extension + "'", "use .png");
  write_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

cv::Mat bgr_of(const std::vector<std::uint8_t>& rgb, int width, int height) {
  LIGHTSTRIPE_CHECK(width > 0 && height > 0 &&
                        rgb.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3,
                    "an RGB picture has width * height * 3 bytes");
  cv::Mat bgr;
  cv::cvtColor(cv::Mat(height, width, CV_8UC3, const_cast<std::uint8_t*>(rgb.data())), bgr,
               cv::COLOR_RGB2BGR);
  return bgr;
}

}  // namespace

void write_image(const std::filesystem::path& path, ImageView8 image) {
  // OpenCV takes no pointer to const; it is only read.
  write_mat(path, cv::Mat(image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.data),
                          static_cast<std::size_t>(image.stride)));
}

void write_rgb_image(const std::filesystem::path& path, const std::vector<std::uint8_t>& rgb, int width,
                     int height) {
  write_mat(path, bgr_of(rgb, width, height));
}

std::vector<std::uint8_t> encode_jpeg(const std::vector<std::uint8_t>& rgb, int width, int height,
                                      int quality) {
  std::vector<std::uint8_t> bytes;
  opencv_codecs().encode(".jpg", bgr_of(rgb, width, height), quality, bytes);
  return bytes;
}

}  // namespace lightstripe
