// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// OpenCV's image and video codecs behind a table of functions. They stand on more than 200 shared libraries
// (FFmpeg, GStreamer, GDAL ...), most of the time that a program takes to start: the program `lightstripe`
// loads them when the first picture or video needs them (apps/load_codecs.cpp). Who links the library has
// them linked.
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

namespace cv {
class VideoCapture;
}

namespace lightstripe {

struct OpencvCodecs {
  /// Grey or colour in the file's depth, not turned by EXIF; empty where it cannot be decoded.
  cv::Mat (*decode)(const cv::Mat& bytes);
  /// Whether OpenCV writes files of this extension (".png").
  bool (*can_encode)(const std::string& extension);
  /// False where it fails. `setting`: of JPEG the quality, 0 to 100; of PNG the compression, 0 to 9; none:
  /// OpenCV's own.
  bool (*encode)(const std::string& extension, const cv::Mat& picture, std::optional<int> setting,
                 std::vector<std::uint8_t>& bytes);
  /// Not opened yet. Its functions are virtual, so that who calls them needs no library.
  std::unique_ptr<cv::VideoCapture> (*new_capture)();
};

/// The codecs in use: those that are linked, unless the program defines this function itself.
const OpencvCodecs& opencv_codecs();

/// The codecs that are linked.
const OpencvCodecs& linked_opencv_codecs();

}  // namespace lightstripe
