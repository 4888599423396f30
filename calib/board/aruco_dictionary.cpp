// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/board/aruco_dictionary.h"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "calib/board/marker_cells.h"
#include "core/error.h"

namespace lightstripe {
namespace {

constexpr std::array<std::pair<std::string_view, int>, 18> kDictionaries{
    {{"DICT_4X4_50", cv::aruco::DICT_4X4_50},
     {"DICT_4X4_100", cv::aruco::DICT_4X4_100},
     {"DICT_4X4_250", cv::aruco::DICT_4X4_250},
     {"DICT_4X4_1000", cv::aruco::DICT_4X4_1000},
     {"DICT_5X5_50", cv::aruco::DICT_5X5_50},
     {"DICT_5X5_100", cv::aruco::DICT_5X5_100},
     {"DICT_5X5_250", cv::aruco::DICT_5X5_250},
     {"DICT_5X5_1000", cv::aruco::DICT_5X5_1000},
     {"DICT_6X6_50", cv::aruco::DICT_6X6_50},
     {"DICT_6X6_100", cv::aruco::DICT_6X6_100},
     {"DICT_6X6_250", cv::aruco::DICT_6X6_250},
     {"DICT_6X6_1000", cv::aruco::DICT_6X6_1000},
     {"DICT_7X7_50", cv::aruco::DICT_7X7_50},
     {"DICT_7X7_100", cv::aruco::DICT_7X7_100},
     {"DICT_7X7_250", cv::aruco::DICT_7X7_250},
     {"DICT_7X7_1000", cv::aruco::DICT_7X7_1000},
     {"DICT_APRILTAG_36h11", cv::aruco::DICT_APRILTAG_36h11},
     {"DICT_ARUCO_ORIGINAL", cv::aruco::DICT_ARUCO_ORIGINAL}}};

}  // namespace

cv::Ptr<cv::aruco::Dictionary> aruco_dictionary(const std::string& wanted) {
  for (const auto& [name, number] : kDictionaries)
    if (name == wanted) return cv::aruco::getPredefinedDictionary(number);
  throw Error("target.dictionary", wanted + " is no dictionary of OpenCV",
              "give its name, for example DICT_5X5_100");
}

MarkerCells marker_cells(const std::string& dictionary, int id, int border_bits) {
  const auto markers = aruco_dictionary(dictionary);
  if (id >= markers->bytesList.rows)
    throw Error("target.dictionary",
                fmt::format("{} has {} markers only", dictionary, markers->bytesList.rows),
                "choose a larger dictionary, or fewer squares");
  MarkerCells cells;
  cells.side = markers->markerSize + 2 * border_bits;
  cv::Mat picture;
  cv::aruco::drawMarker(markers, id, cells.side, picture, border_bits);
  for (int y = 0; y < cells.side; ++y)
    for (int x = 0; x < cells.side; ++x) cells.is_black.push_back(picture.at<std::uint8_t>(y, x) < 128);
  return cells;
}

}  // namespace lightstripe
