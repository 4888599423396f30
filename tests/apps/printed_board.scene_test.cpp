// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// `generate board` as another program prints it (poppler, librsvg) and as OpenCV's own detectors see it: the
// right number of corners at the right size.
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <opencv2/aruco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "command_line.h"
#include "io/images.h"

namespace lightstripe {
namespace {

constexpr double kDpi = 254, kPxPerMm = kDpi / 25.4;

bool there_is(const std::string& program) {
  return std::system(("command -v " + program + " > /dev/null").c_str()) == 0;
}

class PrintedBoard : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (!there_is(GetParam() == "pdf" ? "pdftoppm" : "rsvg-convert"))
      GTEST_SKIP() << "Debian's poppler-utils and librsvg2-bin are not installed";
  }

  /// The board drawn and printed at 254 dpi, 10 px a mm.
  cv::Mat printed(const std::string& target) const {
    const auto drawing = folder_ / ("board." + GetParam()), picture = folder_ / "board.png";
    const auto made = run_lightstripe("generate board --target '" + target + "' -o " + quoted(drawing));
    EXPECT_EQ(made.exit_code, 0) << made.err;
    const std::string command =
        GetParam() == "pdf"
            ? "pdftoppm -r 254 -gray -png -singlefile " + quoted(drawing) + " " + quoted(folder_ / "board")
            : "rsvg-convert -b white -d 254 -p 254 " + quoted(drawing) + " -o " + quoted(picture);
    EXPECT_EQ(std::system(command.c_str()), 0);
    Image8 image = read_image(picture, Channel::kGray);
    return cv::Mat(image.height, image.width, CV_8U, image.pixels.data()).clone();
  }

  TemporaryFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(Formats, PrintedBoard, ::testing::Values("svg", "pdf"));

/// Distance of the first two points, and of the first to the last, mm.
void expect_lengths(const std::vector<cv::Point2f>& points, double px_per_mm, double first_mm,
                    double all_mm) {
  EXPECT_NEAR(cv::norm(points[1] - points[0]) / px_per_mm, first_mm, 0.05);
  EXPECT_NEAR(cv::norm(points.back() - points.front()) / px_per_mm, all_mm, 0.1);
}

TEST_P(PrintedBoard, Checkerboard) {
  std::vector<cv::Point2f> corners;
  ASSERT_TRUE(cv::findChessboardCornersSB(printed("{type: checkerboard, inner_corners: [11, 8], square: 10}"),
                                          {11, 8}, corners));
  expect_lengths(corners, kPxPerMm, 10, std::hypot(100, 70));
}

TEST_P(PrintedBoard, Circles) {
  constexpr double kSmaller = 0.25;  // OpenCV's blob detector wants small blobs
  cv::Mat image = printed("{type: circles, grid: [7, 6], pitch: 20}"), small;
  cv::resize(image, small, {}, kSmaller, kSmaller, cv::INTER_AREA);
  std::vector<cv::Point2f> centres;
  ASSERT_TRUE(cv::findCirclesGrid(small, {7, 6}, centres));
  expect_lengths(centres, kSmaller * kPxPerMm, 20, std::hypot(120, 100));
  image = printed("{type: asymmetric-circles, grid: [4, 11], pitch: 15}");
  cv::resize(image, small, {}, kSmaller, kSmaller, cv::INTER_AREA);
  ASSERT_TRUE(cv::findCirclesGrid(small, {4, 11}, centres, cv::CALIB_CB_ASYMMETRIC_GRID));
  expect_lengths(centres, kSmaller * kPxPerMm, 30, std::hypot(90, 150));
}

/// Corners of the markers by their number.
std::map<int, std::vector<cv::Point2f>> markers(const cv::Mat& image, int dictionary, int border_bits) {
  auto parameters = cv::aruco::DetectorParameters::create();
  parameters->markerBorderBits = border_bits;
  parameters->cornerRefinementMethod = cv::aruco::CORNER_REFINE_SUBPIX;
  std::vector<std::vector<cv::Point2f>> corners;
  std::vector<int> ids;
  cv::aruco::detectMarkers(image, cv::aruco::getPredefinedDictionary(dictionary), corners, ids, parameters);
  std::map<int, std::vector<cv::Point2f>> found;
  for (std::size_t i = 0; i < ids.size(); ++i) found[ids[i]] = corners[i];
  return found;
}

TEST_P(PrintedBoard, Charuco) {
  const auto found = markers(
      printed("{type: charuco, inner_corners: [8, 6], square: 20, marker: 14, dictionary: DICT_5X5_100}"),
      cv::aruco::DICT_5X5_100, 1);
  ASSERT_EQ(found.size(), 31u);  // of 9 x 7 squares the white ones
  EXPECT_NEAR(cv::norm(found.at(0)[1] - found.at(0)[0]) / kPxPerMm, 14, 0.05);
  EXPECT_NEAR(cv::norm(found.at(1)[0] - found.at(0)[0]) / kPxPerMm, 40, 0.05);
}

TEST_P(PrintedBoard, AprilGrid) {
  const auto file = folder_ / "april.yaml";
  write_text(file, "target_type: 'aprilgrid'\ntagCols: 6\ntagRows: 5\ntagSize: 0.021\ntagSpacing: 0.3\n");
  const auto found =
      markers(printed("{type: aprilgrid, file: " + file.string() + "}"), cv::aruco::DICT_APRILTAG_36h11, 2);
  ASSERT_EQ(found.size(), 30u);
  EXPECT_NEAR(cv::norm(found.at(0)[1] - found.at(0)[0]) / kPxPerMm, 21, 0.05);
  EXPECT_NEAR(cv::norm(found.at(1)[0] - found.at(0)[0]) / kPxPerMm, 27.3, 0.05);
  EXPECT_GT(found.at(0)[0].y, found.at(6)[0].y);  // Kalibr's tag 0 is at the bottom left
}

}  // namespace
}  // namespace lightstripe
