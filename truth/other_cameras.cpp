// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "truth/other_cameras.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <variant>

#include "core/error.h"
#include "io/decode_picture.h"

namespace lightstripe {
namespace {

cv::Mat pixels_of(const RgbImage& picture) {
  // OpenCV takes no pointer to const; it is only read.
  return {picture.height, picture.width, CV_8UC3, const_cast<std::uint8_t*>(picture.pixels.data())};
}

std::string ppm(const cv::Mat& rgb) {
  CV_Assert(rgb.isContinuous());
  std::string file = fmt::format("P6\n{} {}\n255\n", rgb.cols, rgb.rows);
  return file.append(reinterpret_cast<const char*>(rgb.data), rgb.total() * rgb.elemSize());
}

/// Each grey value times `gain` plus `offset`.
std::string scaled(const RgbImage& picture, double gain, double offset) {
  cv::Mat out;
  pixels_of(picture).convertTo(out, CV_8U, gain, offset);
  return ppm(out);
}

std::string with_gamma(const RgbImage& picture, double exponent) {
  cv::Mat table(1, 256, CV_8U), out;
  for (int k = 0; k < 256; ++k)
    table.at<std::uint8_t>(k) = static_cast<std::uint8_t>(std::lround(255 * std::pow(k / 255.0, exponent)));
  cv::LUT(pixels_of(picture), table, out);
  return ppm(out);
}

std::string blurred(const RgbImage& picture, double sigma) {
  cv::Mat out;
  cv::GaussianBlur(pixels_of(picture), out, {}, sigma);
  return ppm(out);
}

std::string noisy(const RgbImage& picture, double sigma) {
  cv::Mat noise(picture.height, picture.width, CV_16SC3), out;
  cv::RNG random(static_cast<std::uint64_t>(picture.pixels.size()));
  random.fill(noise, cv::RNG::NORMAL, 0, sigma);
  cv::add(pixels_of(picture), noise, out, cv::noArray(), CV_8U);
  return ppm(out);
}

std::string grey(const RgbImage& picture) {
  cv::Mat out;
  cv::cvtColor(pixels_of(picture), out, cv::COLOR_RGB2GRAY);
  cv::cvtColor(out, out, cv::COLOR_GRAY2RGB);
  return ppm(out);
}

std::string red_and_green_swapped(const RgbImage& picture) {
  cv::Mat out(picture.height, picture.width, CV_8UC3);
  const std::array<int, 6> from_to = {0, 1, 1, 0, 2, 2};
  const cv::Mat in = pixels_of(picture);
  cv::mixChannels(&in, 1, &out, 1, from_to.data(), 3);
  return ppm(out);
}

std::string jpeg(const RgbImage& picture, int quality) {
  const auto bytes = encode_jpeg(picture.pixels, picture.width, picture.height, quality);
  return {bytes.begin(), bytes.end()};
}

constexpr std::array<OtherCamera, 14> kCameras = {{
    {"as they are", [](const RgbImage& p) { return scaled(p, 1, 0); }},
    {"video range 16 to 235", [](const RgbImage& p) { return scaled(p, 219.0 / 255, 16); }},
    {"0.6 times as bright", [](const RgbImage& p) { return scaled(p, 0.6, 0); }},
    {"1.5 times overexposed", [](const RgbImage& p) { return scaled(p, 1.5, 0); }},
    {"gamma 0.7", [](const RgbImage& p) { return with_gamma(p, 0.7); }},
    {"gamma 1.4", [](const RgbImage& p) { return with_gamma(p, 1.4); }},
    {"blurred by 0.7 px", [](const RgbImage& p) { return blurred(p, 0.7); }},
    {"blurred by 1 px", [](const RgbImage& p) { return blurred(p, 1); }},
    {"noise of 3 grey levels", [](const RgbImage& p) { return noisy(p, 3); }},
    {"noise of 6 grey levels", [](const RgbImage& p) { return noisy(p, 6); }},
    {"JPEG of quality 60", [](const RgbImage& p) { return jpeg(p, 60); }},
    {"JPEG of quality 30", [](const RgbImage& p) { return jpeg(p, 30); }},
    {"red and green swapped", red_and_green_swapped},
    {"grey", grey},
}};

}  // namespace

std::span<const OtherCamera> other_cameras() { return kCameras; }

const OtherCamera& other_camera(std::string_view name) {
  const auto* found =
      std::find_if(kCameras.begin(), kCameras.end(), [&](const OtherCamera& c) { return c.name == name; });
  LIGHTSTRIPE_CHECK(found != kCameras.end(), "no such camera");
  return *found;
}

Image8 imitated(const OtherCamera& camera, const RgbImage& picture) {
  return std::get<Image8>(
      decode_picture(camera.imitate(picture), std::string(camera.name), Channel::kAuto, Bits::kReducedTo8));
}

}  // namespace lightstripe
