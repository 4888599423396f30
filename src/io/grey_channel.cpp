// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/grey_channel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string_view>

#include "core/error.h"
#include "io/laser_colour.h"

namespace lightstripe {
namespace {

/// One of the planes B, G, R minus the larger of the other two, 0 if negative.
cv::Mat excess(const std::array<cv::Mat, 3>& bgr, std::size_t plane) {
  cv::Mat larger, difference;
  cv::max(bgr.at((plane + 1) % 3), bgr.at((plane + 2) % 3), larger);
  cv::subtract(bgr.at(plane), larger, difference);  // saturates at 0
  return difference;
}

cv::Mat excess_without_cast(const std::array<cv::Mat, 3>& bgr, std::size_t plane) {
  cv::Mat difference;
  cv::subtract(bgr.at(plane), larger_other(bgr, plane), difference);
  return difference;
}

std::array<cv::Mat, 3> planes(const cv::Mat& picture) {
  std::array<cv::Mat, 3> bgr;
  cv::split(picture, bgr.data());
  return bgr;
}

std::size_t plane_of(Channel channel) {
  const std::string_view name = enum_name(channel);
  return name.starts_with("blue") ? 0 : name.starts_with("green") ? 1 : 2;
}

bool is_laser(Channel channel) { return channel >= Channel::kRedLaser && channel <= Channel::kBlueTextured; }

bool is_clipped(Channel channel) {
  return channel == Channel::kRedClipped || channel == Channel::kGreenClipped ||
         channel == Channel::kBlueClipped;
}

bool is_textured(Channel channel) {
  return channel == Channel::kRedTextured || channel == Channel::kGreenTextured ||
         channel == Channel::kBlueTextured;
}

/// Half of the laser's own plane and a quarter of both others: where the one is clipped, the others still
/// show the line's middle.
cv::Mat clipped_light(const std::array<cv::Mat, 3>& bgr, std::size_t plane) {
  cv::Mat others, light;
  cv::addWeighted(bgr.at((plane + 1) % 3), 0.5, bgr.at((plane + 2) % 3), 0.5, 0, others);
  cv::addWeighted(bgr.at(plane), 0.5, others, 0.5, 0, light);
  return light;
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
  if (picture.channels() == 1) return {};
  constexpr std::array<Channel, 3> kPlain = {Channel::kBlueLaser, Channel::kGreenLaser, Channel::kRedLaser},
                                   kClipped = {Channel::kBlueClipped, Channel::kGreenClipped,
                                               Channel::kRedClipped},
                                   kTextured = {Channel::kBlueTextured, Channel::kGreenTextured,
                                                Channel::kRedTextured};
  const LaserVote vote = vote_for_laser(planes(picture));
  if (vote.plane < 0) return {};
  const auto& form = vote.clipped ? kClipped : vote.textured ? kTextured : kPlain;
  return {form.at(static_cast<std::size_t>(vote.plane)), vote.score};
}

Image8 grey_values(const cv::Mat& picture, Channel channel, const std::string& file) {
  LIGHTSTRIPE_CHECK(channel != Channel::kAuto, "auto is decided by strongest_channel");
  if (picture.channels() == 1) {
    check_grey_channel(channel, file);
    return image8_of(picture);
  }
  if (is_laser(channel)) {
    const auto bgr = planes(picture);
    const std::size_t plane = plane_of(channel);
    Image8 image = image8_of(is_clipped(channel)    ? clipped_light(bgr, plane)
                             : is_textured(channel) ? excess_without_cast(bgr, plane)
                                                    : bgr.at(plane));
    LaserColour colour = where_laser_colour(bgr, plane);
    image.where = std::move(colour.where);
    image.rise = std::move(colour.rise);
    return image;
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
