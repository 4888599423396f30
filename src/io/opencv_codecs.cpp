// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/opencv_codecs.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

namespace lightstripe {
namespace {

cv::Mat decode(const cv::Mat& bytes) {
  try {
    return cv::imdecode(bytes, cv::IMREAD_ANYDEPTH | cv::IMREAD_ANYCOLOR | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception&) {
    return {};
  }
}

bool can_encode(const std::string& extension) {
  try {
    return cv::haveImageWriter("picture" + extension);
  } catch (const cv::Exception&) {
    return false;
  }
}

bool encode(const std::string& extension, const cv::Mat& picture, std::optional<int> setting,
            std::vector<std::uint8_t>& bytes) {
  std::vector<int> parameters;
  if (setting && extension == ".jpg") parameters = {cv::IMWRITE_JPEG_QUALITY, *setting};
  if (setting && extension == ".png") parameters = {cv::IMWRITE_PNG_COMPRESSION, *setting};
  try {
    return cv::imencode(extension, picture, bytes, parameters);
  } catch (const cv::Exception&) {
    return false;
  }
}

std::unique_ptr<cv::VideoCapture> new_capture() { return std::make_unique<cv::VideoCapture>(); }

}  // namespace

const OpencvCodecs& linked_opencv_codecs() {
  static constexpr OpencvCodecs codecs{decode, can_encode, encode, new_capture};
  return codecs;
}

}  // namespace lightstripe
