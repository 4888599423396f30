// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/preview.h"

#include <algorithm>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "io/images.h"

namespace lightstripe {
namespace {

constexpr int kWidth = 1200, kHeight = 800, kMargin = 40;

struct Span {
  float low, high;
};

/// The middle 99.8 % of the values: a few stray points must not shrink the picture.
Span robust_span(std::vector<float> values) {
  const std::size_t cut = values.size() / 1000;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(cut), values.end());
  const float low = values[cut];
  const std::size_t top = values.size() - 1 - cut;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(top), values.end());
  return {low, std::max(values[top], low + 1e-3F)};
}

/// Points to (right, up, towards the viewer).
std::vector<Eigen::Vector3f> as_seen(const std::vector<Eigen::Vector3f>& points, double azimuth_deg, double elevation_deg) {
  const double azimuth = azimuth_deg * std::numbers::pi / 180, elevation = elevation_deg * std::numbers::pi / 180;
  const Eigen::Vector3d towards(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                                std::sin(elevation));
  const Eigen::Vector3d right = Eigen::Vector3d::UnitZ().cross(towards).normalized();
  Eigen::Matrix3d view;
  view << right.transpose(), towards.cross(right).transpose(), towards.transpose();
  const Eigen::Matrix3f turn = view.cast<float>();
  std::vector<Eigen::Vector3f> seen;
  seen.reserve(points.size());
  for (const auto& p : points) seen.push_back(turn * p);
  return seen;
}

std::vector<float> coordinate(const std::vector<Eigen::Vector3f>& points, int axis) {
  std::vector<float> values;
  values.reserve(points.size());
  for (const auto& p : points) values.push_back(p[axis]);
  return values;
}

}  // namespace

void CloudPreview::add(const Profile& profile) {
  for (const auto& point : profile.points) {
    const std::uint64_t index = seen_++;
    if (points_.size() < kMaxPoints) {
      points_.push_back(point.position.cast<float>());
    } else if (const std::uint64_t slot = random_.bits() % (index + 1); slot < kMaxPoints) {
      points_[slot] = point.position.cast<float>();
    }
  }
}

void CloudPreview::write(const std::string& path, double azimuth_deg, double elevation_deg) const {
  cv::Mat3b picture(kHeight, kWidth, cv::Vec3b(24, 22, 20));
  if (!points_.empty()) {
    const auto seen = as_seen(points_, azimuth_deg, elevation_deg);
    const Span across = robust_span(coordinate(seen, 0)), up = robust_span(coordinate(seen, 1));
    const Span height = robust_span(coordinate(points_, 2));
    const float scale = std::min((kWidth - 2 * kMargin) / (across.high - across.low), (kHeight - 2 * kMargin) / (up.high - up.low));
    cv::Mat1b ramp(256, 1);
    for (int i = 0; i < 256; ++i) ramp(i, 0) = static_cast<std::uint8_t>(i);
    cv::Mat3b colors;
    cv::applyColorMap(ramp, colors, cv::COLORMAP_TURBO);
    cv::Mat1f depth(kHeight, kWidth, -std::numeric_limits<float>::max());
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const float px = kWidth / 2.0F + scale * (seen[i].x() - (across.low + across.high) / 2);
      const float py = kHeight / 2.0F - scale * (seen[i].y() - (up.low + up.high) / 2);
      if (!(px >= 0 && py >= 0 && px < kWidth - 1 && py < kHeight - 1)) continue;
      const float part = std::clamp((points_[i].z() - height.low) / (height.high - height.low), 0.0F, 1.0F);
      const cv::Vec3b bgr = colors(static_cast<int>(30 + part * 200), 0);
      for (int dy = 0; dy < 2; ++dy) {
        for (int dx = 0; dx < 2; ++dx) {
          const int x = static_cast<int>(px) + dx, y = static_cast<int>(py) + dy;
          if (seen[i].z() <= depth(y, x)) continue;
          depth(y, x) = seen[i].z();
          picture(y, x) = bgr;
        }
      }
    }
  }
  cv::Mat3b rgb;
  cv::cvtColor(picture, rgb, cv::COLOR_BGR2RGB);
  const auto* data = rgb.ptr<std::uint8_t>();
  write_rgb_image(path, std::vector<std::uint8_t>(data, data + rgb.total() * 3), kWidth, kHeight);
}

}  // namespace lightstripe
