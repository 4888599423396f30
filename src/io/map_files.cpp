// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/map_files.h"

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/opencv_codecs.h"

namespace lightstripe {
namespace {

void encode(const std::filesystem::path& path, const char* extension, const cv::Mat& map) {
  std::vector<std::uint8_t> bytes;
  if (!opencv_codecs().encode(extension, map, std::nullopt, bytes))
    throw Error(path.string(), "cannot be encoded", "give a larger raster, or a shorter scan");
  write_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

template <class T>
cv::Mat mat_of(const std::vector<T>& values, int width, int height, int type) {
  LIGHTSTRIPE_CHECK(width > 0 && height > 0 &&
                        values.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                    "a map has width * height values");
  return cv::Mat(height, width, type, const_cast<T*>(values.data()));  // is only read
}

}  // namespace

void write_float_tiff(const std::filesystem::path& path, const std::vector<float>& values, int width,
                      int height) {
  encode(path, ".tiff", mat_of(values, width, height, CV_32FC1));
}

void write_grey16_png(const std::filesystem::path& path, const std::vector<std::uint16_t>& values, int width,
                      int height) {
  encode(path, ".png", mat_of(values, width, height, CV_16UC1));
}

std::vector<float> read_float_tiff(const std::filesystem::path& path, int* width, int* height) {
  const std::string bytes = read_file(path, std::size_t{1} << 31);
  const cv::Mat map = opencv_codecs().decode(
      cv::Mat(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data())));
  if (map.empty() || map.type() != CV_32FC1)
    throw Error(path.string(), "is no float TIFF of one channel", "give a map that lightstripe wrote");
  *width = map.cols, *height = map.rows;
  return {map.ptr<float>(), map.ptr<float>() + map.total()};
}

}  // namespace lightstripe
