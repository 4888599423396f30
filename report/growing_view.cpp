// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/growing_view.h"

#include <fmt/format.h>

#include "io/atomic_file.h"

namespace lightstripe {
namespace {

std::vector<std::string> sensor_names(const Rig& rig) {
  std::vector<std::string> names;
  for (const Sensor& sensor : rig.sensors) names.push_back(sensor.name);
  return names;
}

}  // namespace

GrowingView::GrowingView(std::filesystem::path page, std::string title, std::vector<std::string> sensors,
                         std::chrono::milliseconds every)
    : page_(std::move(page)), every_(every) {
  view_.title = std::move(title);
  view_.sensors = std::move(sensors);
}

GrowingView::GrowingView(const ReconstructJob& job, const std::filesystem::path& page)
    : GrowingView(page, job.cloud.filename().string() + " (growing)", sensor_names(job.rig)) {}

void GrowingView::add(const Profile& profile) {
  for (const ProfilePoint& p : profile.points) {
    if (view_.total++ % step_ != 0) continue;
    view_.points.push_back({static_cast<float>(p.position.x()), static_cast<float>(p.position.y()),
                            static_cast<float>(p.position.z()), p.intensity,
                            static_cast<std::int32_t>(profile.frame), p.sensor, p.line,
                            static_cast<float>(p.sigma_mm)});
  }
  if (view_.points.size() > kMostPoints) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < view_.points.size(); i += 2) view_.points[kept++] = view_.points[i];
    view_.points.resize(kept);
    step_ *= 2;
  }
  const auto now = std::chrono::steady_clock::now();
  if (view_.points.empty() || now - written_ < every_) return;
  write();
  written_ = std::chrono::steady_clock::now();
}

void GrowingView::write() {
  std::string html = cloud_view_html(view_);
  const std::size_t head = html.find("<head>");
  const auto seconds = std::max<std::int64_t>(1, std::chrono::ceil<std::chrono::seconds>(every_).count());
  if (head != std::string::npos)
    html.insert(head + 6, fmt::format("<meta http-equiv=\"refresh\" content=\"{}\">", seconds));
  write_file(page_, html);
}

void show_growth(ReconstructJob& job, GrowingView& view) {
  job.on_profile = [&view, before = job.on_profile](const Profile& profile) {
    if (before) before(profile);
    view.add(profile);
  };
}

}  // namespace lightstripe
