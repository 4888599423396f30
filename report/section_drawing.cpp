// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/section_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/error.h"
#include "core/robust.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

/// Differences beyond half a millimetre are wear to be seen, below 0.1 they are noise.
const char* colour_of(double difference) {
  if (difference > 0.1) return "#2a7ab8";
  return difference < -0.1 ? "#c8401f" : "#4a9a4a";
}

cv::Scalar rgb_of(double difference) {
  if (difference > 0.1) return {42, 122, 184};
  return difference < -0.1 ? cv::Scalar(200, 64, 31) : cv::Scalar(74, 154, 74);
}

/// A round factor that makes nearly all differences at most 12 mm long.
double enlargement(std::vector<double> sizes) {
  constexpr double kLongestMm = 12;
  if (sizes.empty()) return 10;
  const double nearly_all = quantile(sizes, 0.97);
  for (const double factor : {50.0, 20.0, 10.0, 5.0, 2.0})
    if (nearly_all * factor <= kLongestMm) return factor;
  return 1;
}

void frame_view(ObjectKind kind, SectionDrawing& drawing) {
  // A rail whole; of a wheel what a sensor can see of it.
  drawing.low = kind == ObjectKind::kRail ? Vector2d(-92, -180) : Vector2d(-88, -35);
  drawing.high = kind == ObjectKind::kRail ? Vector2d(92, 16) : Vector2d(82, 46);
}

void add_reference(const ReferenceShape& reference, SectionDrawing& drawing) {
  std::vector<Vector2d> line;
  for (const OutlineSample& point : sample(reference.outline(), 0.5)) line.push_back(point.position);
  if (reference.outline().closed()) line.push_back(line.front());
  drawing.reference.push_back(std::move(line));
}

std::string path_of(const std::vector<Vector2d>& line) {
  std::string path;
  for (const Vector2d& p : line)
    fmt::format_to(std::back_inserter(path), "{}{:.2f} {:.2f}", path.empty() ? "M" : "L", p.x(), -p.y());
  return path;
}

}  // namespace

SectionDrawing draw_section(const Profile& profile, const Registration& registration,
                            const ReferenceShape& reference) {
  SectionDrawing drawing;
  frame_view(reference.kind(), drawing);
  add_reference(reference, drawing);
  if (registration.view == RegistrationView::kNone) return drawing;
  std::vector<double> sizes;
  std::vector<PolylineFoot> feet;
  for (const ProfilePoint& point : profile.points) {
    const Vector2d p = registration.reference_from_section * Vector2d(point.u, point.v);
    drawing.points.push_back(p);
    if (const auto foot = reference.nearest(p); foot && !foot->beyond_end)
      feet.push_back(*foot), sizes.push_back(std::abs(foot->signed_distance));
  }
  drawing.enlarged = enlargement(std::move(sizes));
  for (const PolylineFoot& foot : feet)  // always outwards, where nothing else is drawn
    drawing.whiskers.push_back(
        {foot.position, foot.position + drawing.enlarged * std::abs(foot.signed_distance) * foot.normal,
         foot.signed_distance});
  return drawing;
}

std::string section_svg(const SectionDrawing& drawing, int width_px) {
  const Vector2d size = drawing.high - drawing.low;
  std::string svg =
      fmt::format("<svg width=\"{}\" viewBox=\"{:.1f} {:.1f} {:.1f} {:.1f}\" style=\"background:#fff\">",
                  width_px, drawing.low.x(), -drawing.high.y(), size.x(), size.y());
  for (const auto& line : drawing.reference)
    svg += fmt::format("<path d=\"{}\" fill=\"#eee\" stroke=\"#999\" stroke-width=\"0.4\"/>", path_of(line));
  // One path a colour: a section has a thousand whiskers.
  for (const double sample : {-1.0, 0.0, 1.0}) {
    std::string path;
    for (const auto& whisker : drawing.whiskers)
      if (colour_of(whisker.difference) == std::string_view(colour_of(sample)))
        fmt::format_to(std::back_inserter(path), "M{:.2f} {:.2f}L{:.2f} {:.2f}", whisker.foot.x(),
                       -whisker.foot.y(), whisker.end.x(), -whisker.end.y());
    svg += fmt::format("<path d=\"{}\" stroke=\"{}\" stroke-width=\"0.35\"/>", path, colour_of(sample));
  }
  std::string dots;
  for (const Vector2d& p : drawing.points)
    fmt::format_to(std::back_inserter(dots), "M{:.2f} {:.2f}h0", p.x(), -p.y());
  return svg +
         fmt::format("<path d=\"{}\" stroke=\"#222\" stroke-width=\"0.5\" stroke-linecap=\"round\"/></svg>",
                     dots);
}

RgbPicture section_picture(const SectionDrawing& drawing, const MeasuredFrame& row, int width_px) {
  const Vector2d size = drawing.high - drawing.low;
  const double scale = width_px / size.x();
  const int text_px = 30 * static_cast<int>((row.estimates.size() + row.extras.size() + 5) / 2);
  cv::Mat image(static_cast<int>(size.y() * scale) + text_px, width_px, CV_8UC3, cv::Scalar(255, 255, 255));
  const auto at = [&](const Vector2d& p) {
    constexpr double kSixteenth = 16;  // cv draws with four fractional bits here
    return cv::Point(cvRound((p.x() - drawing.low.x()) * scale * kSixteenth),
                     cvRound((drawing.high.y() - p.y()) * scale * kSixteenth));
  };
  for (const auto& line : drawing.reference)
    for (std::size_t i = 1; i < line.size(); ++i)
      cv::line(image, at(line[i - 1]), at(line[i]), {150, 150, 150}, 2, cv::LINE_AA, 4);
  for (const auto& w : drawing.whiskers)
    cv::line(image, at(w.foot), at(w.end), rgb_of(w.difference), 1, cv::LINE_AA, 4);
  for (const Vector2d& p : drawing.points)
    cv::circle(image, at(p), 32, {30, 30, 30}, cv::FILLED, cv::LINE_AA, 4);
  cv::rectangle(image, {0, image.rows - text_px, image.cols, text_px}, {255, 255, 255}, cv::FILLED);
  int y = image.rows - text_px + 24, column = 0;
  const auto write = [&](const std::string& text) {
    cv::putText(image, text, {20 + column * width_px / 2, y}, cv::FONT_HERSHEY_SIMPLEX, 0.65, {20, 20, 20}, 1,
                cv::LINE_AA);
    if (++column == 2) column = 0, y += 30;
  };
  write(fmt::format("frame {}, travel {:.3f}, against {}", row.frame, row.travel, row.nominal));
  write(fmt::format("differences drawn {:.0f} times, status {}", drawing.enlarged, row.status));
  for (const auto* list : {&row.estimates, &row.extras})
    for (const NamedEstimate& one : *list) {
      const Estimate& e = one.estimate;
      write(!e.value ? one.name + ": " + e.reason
                     : fmt::format("{}: {:.3f}{}", one.name, *e.value,
                                   e.sigma ? fmt::format(" +- {:.3f}", *e.sigma) : ""));
    }
  RgbPicture picture;
  picture.width = image.cols, picture.height = image.rows;
  picture.pixels.assign(image.datastart, image.dataend);
  return picture;
}

RgbPicture plot_frame(const MeasureResult& result, std::int64_t frame) {
  const auto row = std::find_if(result.rows.begin(), result.rows.end(),
                                [&](const MeasuredFrame& r) { return r.frame == frame; });
  if (row == result.rows.end())
    throw Error(fmt::format("--plot {}", frame), "the sections have no such frame",
                "give the number of a frame in the table");
  const Profile& profile = result.input.profiles[static_cast<std::size_t>(row - result.rows.begin())];
  return section_picture(draw_section(profile, row->registration, result.references.at(row->travel)), *row);
}

}  // namespace lightstripe
