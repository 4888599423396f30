// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/frame_thumbnails.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <variant>

#include "core/error.h"
#include "io/images.h"
#include "io/rig_file.h"
#include "pipeline/frame_links.h"
#include "pipeline/recording.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

constexpr int kWidthPx = 360;

/// 8 bits, brightened by the root so that the object shows beside the stripe.
cv::Mat3b as_picture(const GreyImage& image, int& full_width) {
  cv::Mat grey;
  if (const auto* eight = std::get_if<Image8>(&image)) {
    grey = cv::Mat(eight->height, eight->width, CV_8UC1, const_cast<std::uint8_t*>(eight->pixels.data()))
               .clone();
  } else {
    const auto& wide = std::get<Image16>(image);
    const cv::Mat view(wide.height, wide.width, CV_16UC1, const_cast<std::uint16_t*>(wide.pixels.data()));
    double high = 1;
    cv::minMaxLoc(view, nullptr, &high);
    view.convertTo(grey, CV_8U, 255 / std::max(1.0, high));
  }
  full_width = grey.cols;
  cv::Mat small, real;
  cv::resize(grey, small, {kWidthPx, std::max(1, grey.rows * kWidthPx / grey.cols)}, 0, 0, cv::INTER_AREA);
  small.convertTo(real, CV_32F, 1.0 / 255);
  cv::sqrt(real, real);
  real.convertTo(small, CV_8U, 255);
  cv::Mat3b out;
  cv::cvtColor(small, out, cv::COLOR_GRAY2RGB);
  return out;
}

void draw_points(cv::Mat3b& picture, double scale, const Profile& profile, int sensor, const Sensor& seen_by,
                 const Rigid3& camera_from_result) {
  constexpr double kSixteenth = 16;  // cv draws with four fractional bits here
  for (const ProfilePoint& point : profile.points) {
    if (point.sensor != sensor) continue;
    const auto pixel = project(seen_by.camera, camera_from_result * point.position);
    if (!pixel) continue;
    const cv::Point at(cvRound(((pixel->x() + 0.5) * scale - 0.5) * kSixteenth),
                       cvRound(((pixel->y() + 0.5) * scale - 0.5) * kSixteenth));
    cv::circle(picture, at, 10, {255, 60, 40}, cv::FILLED, cv::LINE_AA, 4);
  }
}

}  // namespace

std::map<std::int64_t, std::vector<FrameThumbnail>> frame_thumbnails(
    const fs::path& scan_file, const fs::path& rig_file, const fs::path& page,
    const std::vector<const Profile*>& profiles) {
  const Scan scan = read_scan(scan_file);
  const Rig rig = read_rig(rig_file.empty() ? scan.folder / scan.rig : rig_file);
  const Recording recording(scan, scan_file.string(), rig);
  std::vector<std::int64_t> frames;
  for (const Profile* profile : profiles) frames.push_back(profile->frame);
  const auto links = frame_links(scan_file.string(), rig_file.string(), page, frames);
  std::map<std::int64_t, std::vector<FrameThumbnail>> out;
  for (const Profile* profile : profiles) {
    const auto named = links.find(profile->frame);
    const auto position = recording.position(profile->frame);
    if (named == links.end() || !position) continue;
    for (const FrameLink& link : named->second)
      for (std::size_t s = 0; s < rig.sensors.size(); ++s) {
        if (rig.sensors[s].name != link.sensor) continue;
        FrameThumbnail one{link.sensor, link.href, {}};
        try {
          if (const auto image = recording.read(profile->frame, static_cast<int>(s))) {
            int full_width = 1;
            cv::Mat3b picture = as_picture(*image, full_width);
            const Rigid3 result_from_camera =
                result_from_rig(rig.motion, *position) * rig.sensors[s].rig_from_camera;
            draw_points(picture, static_cast<double>(kWidthPx) / full_width, *profile, static_cast<int>(s),
                        rig.sensors[s], result_from_camera.inverse());
            one.jpeg =
                encode_jpeg({picture.ptr<std::uint8_t>(), picture.ptr<std::uint8_t>() + picture.total() * 3},
                            picture.cols, picture.rows);
          }
        } catch (const Error&) {
          // a picture that was skipped in the scan: the link alone
        }
        out[profile->frame].push_back(std::move(one));
      }
  }
  return out;
}

}  // namespace lightstripe
