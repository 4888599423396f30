// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/preview.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "core/robust.h"
#include "io/images.h"

namespace lightstripe {
namespace {

constexpr int kMargin = 40;

struct Range {
  float low, high;
};

/// The middle 99.8 % of the values, and no farther from the middle 90 % than these span: stray points must
/// not shrink the picture.
Range robust_span(std::vector<float> values) {
  const auto at = [&](double share) { return quantile(values, share); };
  const float low = at(0.05), high = at(0.95), reach = std::max(high - low, 1e-3F);
  return {std::max(at(0.001), low - reach), std::min(at(0.999), high + reach) + 1e-3F};
}

/// Points to (right, up, towards the viewer).
std::vector<Eigen::Vector3f> as_seen(const std::vector<Eigen::Vector3f>& points, double azimuth_deg,
                                     double elevation_deg) {
  const double azimuth = azimuth_deg * std::numbers::pi / 180,
               elevation = elevation_deg * std::numbers::pi / 180;
  const Eigen::Vector3d towards(std::cos(elevation) * std::cos(azimuth),
                                std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
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

/// 256 colours from blue over green to red, RGB.
cv::Mat3b height_colors() {
  cv::Mat1b ramp(256, 1);
  for (int i = 0; i < 256; ++i) ramp(i, 0) = static_cast<std::uint8_t>(i);
  cv::Mat3b colors;
  cv::applyColorMap(ramp, colors, cv::COLORMAP_TURBO);
  cv::cvtColor(colors, colors, cv::COLOR_BGR2RGB);
  return colors;
}

/// Each point as 2 x 2 pixels, coloured by z; the nearest to the viewer stays.
void draw_points(cv::Mat3b& canvas, const std::vector<Eigen::Vector3f>& points,
                 const std::vector<Eigen::Vector3f>& seen) {
  const Range across = robust_span(coordinate(seen, 0)), up = robust_span(coordinate(seen, 1));
  const Range height = robust_span(coordinate(points, 2));
  const auto room = [](int pixels) { return static_cast<float>(pixels - 2 * kMargin); };
  const float scale =
      std::min(room(canvas.cols) / (across.high - across.low), room(canvas.rows) / (up.high - up.low));
  const cv::Mat3b colors = height_colors();
  cv::Mat1f nearest(canvas.size(), -std::numeric_limits<float>::max());
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const float px =
        static_cast<float>(canvas.cols) / 2 + scale * (seen[i].x() - (across.low + across.high) / 2);
    const float py = static_cast<float>(canvas.rows) / 2 - scale * (seen[i].y() - (up.low + up.high) / 2);
    if (!(px >= 0 && py >= 0 && px < static_cast<float>(canvas.cols - 1) &&
          py < static_cast<float>(canvas.rows - 1)))
      continue;
    const float part = std::clamp((points[i].z() - height.low) / (height.high - height.low), 0.0F, 1.0F);
    for (int corner = 0; corner < 4; ++corner) {
      const int x = static_cast<int>(px) + corner % 2, y = static_cast<int>(py) + corner / 2;
      if (seen[i].z() <= nearest(y, x)) continue;
      nearest(y, x) = seen[i].z();
      canvas(y, x) = colors(static_cast<int>(30 + part * 200), 0);
    }
  }
}

cv::Mat3b as_mat(const RgbPicture& picture) {
  return cv::Mat3b(picture.height, picture.width,
                   reinterpret_cast<cv::Vec3b*>(const_cast<std::uint8_t*>(picture.pixels.data())));
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

RgbPicture CloudPreview::draw(int width, int height, double azimuth_deg, double elevation_deg) const {
  RgbPicture picture{{}, width, height};
  cv::Mat3b canvas(height, width, cv::Vec3b(20, 22, 24));
  if (!points_.empty()) draw_points(canvas, points_, as_seen(points_, azimuth_deg, elevation_deg));
  picture.pixels.assign(canvas.ptr<std::uint8_t>(), canvas.ptr<std::uint8_t>() + canvas.total() * 3);
  return picture;
}

void draw_preview_of(ReconstructJob& job, CloudPreview& preview, const std::filesystem::path& file) {
  job.on_profile = [&preview](const Profile& profile) { preview.add(profile); };
  job.before_end = [&preview, file] {
    const RgbPicture picture = preview.draw();
    write_rgb_image(file, picture.pixels, picture.width, picture.height);
  };
}

RgbPicture compose_overview(const std::vector<RgbPicture>& top, const RgbPicture& bottom) {
  const int cell = bottom.width / static_cast<int>(top.size());
  const int row = top[0].height * cell / top[0].width;
  cv::Mat3b canvas(row + bottom.height, bottom.width, cv::Vec3b(0, 0, 0));
  for (std::size_t i = 0; i < top.size(); ++i)
    cv::resize(as_mat(top[i]), canvas(cv::Rect(static_cast<int>(i) * cell, 0, cell, row)),
               cv::Size(cell, row), 0, 0, cv::INTER_AREA);
  as_mat(bottom).copyTo(canvas(cv::Rect(0, row, bottom.width, bottom.height)));
  return {{canvas.ptr<std::uint8_t>(), canvas.ptr<std::uint8_t>() + canvas.total() * 3},
          canvas.cols,
          canvas.rows};
}

}  // namespace lightstripe
