// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/draw/overlay.h"

#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>

#include "core/error.h"

namespace lightstripe {
namespace {

constexpr int kShift = 4;  // OpenCV draws at 1/16 px

/// A picture pixel's centre lies in the middle of its zoom x zoom block.
cv::Point on_picture(double x, double y, int zoom) {
  const double scale = zoom * (1 << kShift), half = 0.5 * (zoom - 1) * (1 << kShift);
  return {static_cast<int>(std::lround(x * scale + half)), static_cast<int>(std::lround(y * scale + half))};
}

cv::Scalar line_colour(std::size_t line) {
  constexpr std::array<std::array<int, 3>, 10> kColours{{{255, 60, 60},
                                                         {60, 255, 60},
                                                         {80, 160, 255},
                                                         {255, 220, 40},
                                                         {255, 80, 255},
                                                         {40, 240, 240},
                                                         {255, 150, 40},
                                                         {170, 255, 130},
                                                         {180, 130, 255},
                                                         {255, 160, 180}}};
  const auto& c = kColours[line % kColours.size()];
  return cv::Scalar(c[0], c[1], c[2]);
}

void draw_stripe(const Stripe& stripe, std::size_t line, int zoom, cv::Mat& picture) {
  constexpr double kJoined = 3.0;  // px
  const cv::Scalar colour = line_colour(line);
  for (std::size_t i = 0; i < stripe.points.size(); ++i) {
    const StripePoint& p = stripe.points[i];
    const cv::Point at = on_picture(p.x, p.y, zoom);
    if (i > 0) {
      const StripePoint& q = stripe.points[i - 1];
      if (std::hypot(p.x - q.x, p.y - q.y) <= kJoined)
        cv::line(picture, on_picture(q.x, q.y, zoom), at, colour, 1, cv::LINE_AA, kShift);
    }
    if ((p.flags & kStripeBridged) != 0)
      cv::circle(picture, at, (zoom + 2) << kShift, cv::Scalar(255, 255, 255), 1, cv::LINE_AA, kShift);
    else if (zoom > 2)
      cv::circle(picture, at, 1 << kShift, colour, cv::FILLED, cv::LINE_AA, kShift);
  }
  if (stripe.points.empty()) return;
  const StripePoint& first = stripe.points.front();
  cv::putText(picture, std::to_string(line),
              cv::Point(static_cast<int>(first.x * zoom) + 6, static_cast<int>(first.y * zoom) + 14),
              cv::FONT_HERSHEY_SIMPLEX, 0.45, colour, 1, cv::LINE_AA);
}

}  // namespace

std::vector<std::uint8_t> draw_overlay(ImageView8 image, const std::vector<Stripe>& stripes,
                                       const OverlayOptions& options) {
  LIGHTSTRIPE_CHECK(options.zoom >= 1, "zoom starts at 1");
  if (image.empty()) return {};
  const int zoom = options.zoom;
  std::vector<std::uint8_t> rgb(static_cast<std::size_t>(image.width) *
                                static_cast<std::size_t>(image.height) *
                                static_cast<std::size_t>(zoom * zoom) * 3);
  cv::Mat picture(image.height * zoom, image.width * zoom, CV_8UC3, rgb.data());
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x) {
      const auto grey =
          static_cast<std::uint8_t>(std::lround(image(x / zoom, y / zoom) * options.brightness));
      picture.at<cv::Vec3b>(y, x) = {grey, grey, grey};
    }
  for (std::size_t line = 0; line < stripes.size(); ++line) draw_stripe(stripes[line], line, zoom, picture);
  return rgb;
}

void draw_stripes(std::vector<std::uint8_t>& rgb, int width, int height, const std::vector<Stripe>& stripes) {
  LIGHTSTRIPE_CHECK(rgb.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3,
                    "3 bytes a pixel");
  cv::Mat picture(height, width, CV_8UC3, rgb.data());
  for (std::size_t line = 0; line < stripes.size(); ++line) draw_stripe(stripes[line], line, 1, picture);
}

}  // namespace lightstripe
