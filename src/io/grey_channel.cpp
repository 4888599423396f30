// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/grey_channel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/error.h"

namespace lightstripe {
namespace {

// A line of light covers at least this share of a picture; a few coloured pixels are noise or dead ones.
constexpr double kPeakShare = 2e-4;
constexpr int kMinPeakPixels = 16;
// Colour fringes of demosaicing and a wrong white balance stay below this.
constexpr double kMinPeak = 40;  // grey levels

/// One of the planes B, G, R minus the larger of the other two, 0 if negative.
cv::Mat excess(const std::array<cv::Mat, 3>& bgr, std::size_t plane) {
  cv::Mat larger, difference;
  cv::max(bgr.at((plane + 1) % 3), bgr.at((plane + 2) % 3), larger);
  cv::subtract(bgr.at(plane), larger, difference);  // saturates at 0
  return difference;
}

std::array<cv::Mat, 3> planes(const cv::Mat& picture) {
  std::array<cv::Mat, 3> bgr;
  cv::split(picture, bgr.data());
  return bgr;
}

std::size_t plane_of(Channel channel) {
  if (channel == Channel::kBlue || channel == Channel::kBlueExcess) return 0;
  return channel == Channel::kGreen || channel == Channel::kGreenExcess ? 1 : 2;
}

bool is_excess(Channel channel) {
  return channel == Channel::kRedExcess || channel == Channel::kGreenExcess ||
         channel == Channel::kBlueExcess;
}

/// How many pixels have each grey level. Four tables in turn: neighbours are often equal, and counting them
/// in one place would wait for itself.
std::array<std::int64_t, 256> histogram_of(const cv::Mat& grey) {
  std::array<std::array<std::int32_t, 256>, 4> part{};
  for (int y = 0; y < grey.rows; ++y) {
    const auto* row = grey.ptr<std::uint8_t>(y);
    for (int x = 0; x < grey.cols; ++x) ++part[static_cast<unsigned>(x) % 4][row[x]];
  }
  std::array<std::int64_t, 256> histogram{};
  for (std::size_t level = 0; level < 256; ++level)
    for (const auto& counts : part) histogram[level] += counts[level];
  return histogram;
}

/// Grey level that a share kPeakShare of the pixels exceeds, minus the median.
double peak_above_median(const cv::Mat& grey) {
  const std::array<std::int64_t, 256> histogram = histogram_of(grey);
  const auto level_reached_by = [&histogram](std::int64_t count) {
    int level = 255;
    for (std::int64_t above = 0; level > 0; --level) {
      above += histogram[static_cast<std::size_t>(level)];
      if (above >= count) break;
    }
    return level;
  };
  const auto total = static_cast<std::int64_t>(grey.total());
  const auto bright =
      std::max<std::int64_t>(kMinPeakPixels, std::llround(kPeakShare * static_cast<double>(total)));
  return level_reached_by(std::min(bright, total)) - level_reached_by(total / 2 + 1);
}

/// Whether the line's own channel is clipped, so that the other channels catch up in the line's core and the
/// excess has its light at the line's two edges only.
bool is_hollow(const std::array<cv::Mat, 3>& bgr, std::size_t plane, double peak) {
  constexpr double kClipped = 250, kDepth = 60;  // grey levels
  constexpr int kWidestCore = 15;                // px
  constexpr double kHollowShare = 0.1;
  const cv::Mat light = excess(bgr, plane), clipped = bgr.at(plane) >= kClipped;
  if (cv::countNonZero(clipped) < kMinPeakPixels) return false;
  cv::Mat closed;
  cv::morphologyEx(light, closed, cv::MORPH_CLOSE,
                   cv::getStructuringElement(cv::MORPH_RECT, cv::Size(kWidestCore, kWidestCore)));
  const cv::Mat hollow = clipped & (closed - light >= kDepth), bright = light >= 0.5 * peak;
  return cv::countNonZero(hollow) > kHollowShare * cv::countNonZero(bright);
}

template <class T>
Image<T> image_of(const cv::Mat& grey) {
  Image<T> image;
  image.width = grey.cols;
  image.height = grey.rows;
  image.pixels.reserve(grey.total());  // not filled twice
  for (int y = 0; y < grey.rows; ++y)
    image.pixels.insert(image.pixels.end(), grey.ptr<T>(y), grey.ptr<T>(y) + grey.cols);
  return image;
}

}  // namespace

Image8 image8_of(const cv::Mat& grey) { return image_of<std::uint8_t>(grey); }
Image16 image16_of(const cv::Mat& grey) { return image_of<std::uint16_t>(grey); }

void check_grey_channel(Channel channel, const std::string& file) {
  if (is_excess(channel))
    throw Error(file, "is a grey picture and has no colour excess", "set channel: auto or gray");
}

ChannelChoice strongest_channel(const cv::Mat& picture) {
  ChannelChoice best;
  if (picture.channels() == 1) return best;
  const auto bgr = planes(picture);
  for (const Channel channel : {Channel::kRedExcess, Channel::kGreenExcess, Channel::kBlueExcess}) {
    const double peak = peak_above_median(excess(bgr, plane_of(channel)));
    if (peak >= kMinPeak && peak > best.peak) best = {channel, peak};
  }
  // The grey picture still has the line's light in its middle.
  if (best.peak > 0 && is_hollow(bgr, plane_of(best.channel), best.peak)) return {Channel::kGray, best.peak};
  return best;
}

Image8 grey_values(const cv::Mat& picture, Channel channel, const std::string& file) {
  LIGHTSTRIPE_CHECK(channel != Channel::kAuto, "auto is decided by strongest_channel");
  if (picture.channels() == 1) {
    check_grey_channel(channel, file);
    return image8_of(picture);
  }
  cv::Mat grey;
  if (channel == Channel::kGray) {
    cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
  } else if (is_excess(channel)) {
    grey = excess(planes(picture), plane_of(channel));
  } else {
    cv::extractChannel(picture, grey, static_cast<int>(plane_of(channel)));
  }
  return image8_of(grey);
}

}  // namespace lightstripe
