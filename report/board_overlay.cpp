// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/board_overlay.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>

#include "io/images.h"
#include "parallel/parallel.h"
#include "pipeline/overlay_files.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

constexpr int kShift = 4;  // fractional bits of OpenCV's drawing functions

cv::Point fixed_point(double x, double y, double scale) {
  // Pixel centres are integers in both pictures, whatever their size.
  const auto at = [scale](double v) { return static_cast<int>(((v + 0.5) * scale - 0.5) * (1 << kShift)); };
  return {at(x), at(y)};
}

cv::Mat1b gray_of(const SeenPicture& picture) {
  const Image8 board = read_image(picture.board, Channel::kGray);
  cv::Mat1b gray =
      cv::Mat1b(board.height, board.width, const_cast<std::uint8_t*>(board.pixels.data())).clone();
  if (picture.laser.empty()) return gray;
  const Image8 laser = read_image(picture.laser, Channel::kGray);
  if (laser.width != board.width || laser.height != board.height) return gray;
  const cv::Mat1b lit(laser.height, laser.width, const_cast<std::uint8_t*>(laser.pixels.data()));
  return cv::Mat1b(cv::max(gray, lit));
}

void draw_corners(cv::Mat3b& canvas, const std::vector<Eigen::Vector2d>& corners, double scale) {
  const cv::Scalar first(255, 200, 0), other(0, 220, 60);
  std::optional<cv::Point> before;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (!is_seen(corners[i])) {
      before.reset();
      continue;
    }
    const cv::Point p = fixed_point(corners[i].x(), corners[i].y(), scale);
    if (before) cv::line(canvas, *before, p, other, 1, cv::LINE_AA, kShift);
    cv::circle(canvas, p, (i == 0 ? 6 : 3) << kShift, i == 0 ? first : other, 1, cv::LINE_AA, kShift);
    before = p;
  }
}

}  // namespace

OverlayPicture draw_board(const SeenPicture& picture, int max_width_px) {
  cv::Mat1b gray = gray_of(picture);
  double scale = 1;
  if (max_width_px > 0 && gray.cols > max_width_px) {
    scale = static_cast<double>(max_width_px) / gray.cols;
    cv::resize(gray, gray, {}, scale, scale, cv::INTER_AREA);
  }
  cv::Mat3b canvas;
  cv::cvtColor(gray, canvas, cv::COLOR_GRAY2RGB);
  draw_corners(canvas, picture.corners, scale);
  for (const auto& stripe : picture.stripes)
    for (const auto& point : stripe)
      cv::circle(canvas, fixed_point(point.x, point.y, scale), 1 << kShift, {255, 40, 40}, cv::FILLED,
                 cv::LINE_AA, kShift);
  return {{canvas.ptr<std::uint8_t>(), canvas.ptr<std::uint8_t>() + canvas.total() * 3},
          canvas.cols,
          canvas.rows};
}

void write_overlays(const fs::path& folder, const std::vector<SeenPicture>& pictures) {
  std::vector<std::pair<std::string, fs::path>> boards;
  for (const SeenPicture& picture : pictures) boards.emplace_back(picture.sensor, picture.board);
  const std::vector<fs::path> files = board_overlay_files(boards, folder);
  parallel_for(pictures.size(), [&](std::size_t i) {
    const OverlayPicture overlay = draw_board(pictures[i], 0);
    write_rgb_image(files[i], overlay.rgb, overlay.width, overlay.height);
  });
}

}  // namespace lightstripe
