// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/cloud_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/random.h"
#include "report/page.h"

namespace lightstripe {
namespace {

using nlohmann::json;

constexpr double kSteps24 = 16777215, kSteps16 = 65535, kSteps15 = 32767;

struct Span {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
  void add(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  double size() const { return high > low ? high - low : 1; }
};

std::array<Span, 3> extent(const std::vector<CloudPoint>& points) {
  std::array<Span, 3> out;
  for (const CloudPoint& p : points) out[0].add(p.x), out[1].add(p.y), out[2].add(p.z);
  return out;
}

/// Binary columns, the ones of 16 bits first, little-endian; view.js reads them in this order.
class Columns {
 public:
  explicit Columns(std::size_t rows) { bytes_.reserve(rows * 16); }
  void add16(double steps) {
    const auto value = static_cast<std::uint32_t>(std::lround(std::clamp(steps, 0.0, kSteps16)));
    bytes_.push_back(static_cast<std::uint8_t>(value));
    bytes_.push_back(static_cast<std::uint8_t>(value >> 8));
  }
  void add8(std::uint32_t value) { bytes_.push_back(static_cast<std::uint8_t>(value)); }
  std::string text() const { return base64(bytes_); }

 private:
  std::vector<std::uint8_t> bytes_;
};

std::uint32_t steps24(double value, const Span& span) {
  return std::isfinite(value)
             ? static_cast<std::uint32_t>(std::lround((value - span.low) / span.size() * kSteps24))
             : 0;
}

/// Stripes (sensor, line) by number; beyond 255 they share the last.
struct Groups {
  std::map<std::pair<int, int>, std::uint32_t> number;
  json names = json::array();
  std::uint32_t of(const CloudPoint& p) {
    const auto [at, is_new] = number.try_emplace(
        {p.sensor, p.line}, std::min<std::uint32_t>(255, static_cast<std::uint32_t>(number.size())));
    if (is_new && names.size() < 256) names.push_back({p.sensor, p.line});
    return at->second;
  }
};

json span_json(const Span& span, double origin) { return {span.low + origin, span.size()}; }

double largest(const std::vector<CloudPoint>& points, float CloudPoint::*field) {
  double out = 0;
  for (const CloudPoint& p : points)
    if (std::isfinite(p.*field)) out = std::max<double>(out, p.*field);
  return out > 0 ? out : 1;
}

double largest_deviation(const std::vector<float>& values) {
  double out = 1e-3;
  for (const float value : values)
    if (std::isfinite(value)) out = std::max<double>(out, std::abs(value));
  return out;
}

/// 0: not known, else 32768 + deviation / step.
double deviation_steps(float value, double most) {
  return std::isfinite(value) ? kSteps15 + 1 + value / most * kSteps15 : 0;
}

std::string binary_columns(const CloudView& view, const std::array<Span, 3>& box, Groups& groups,
                           json& data) {
  const double brightest = largest(view.points, &CloudPoint::intensity),
               most_sigma = largest(view.points, &CloudPoint::sigma),
               most_deviation = largest_deviation(view.deviation_mm);
  data["intensity_max"] = brightest;
  data["sigma_max"] = most_sigma;
  data["deviation_max"] = most_deviation;
  Columns columns(view.points.size());
  constexpr std::array<float CloudPoint::*, 3> kAxes{&CloudPoint::x, &CloudPoint::y, &CloudPoint::z};
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const CloudPoint& p : view.points) columns.add16(steps24(p.*kAxes[axis], box[axis]) >> 8);
  for (const CloudPoint& p : view.points) columns.add16(p.intensity / brightest * kSteps16);
  for (const CloudPoint& p : view.points) columns.add16(p.sigma / most_sigma * kSteps16);
  for (const float value : view.deviation_mm) columns.add16(deviation_steps(value, most_deviation));
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const CloudPoint& p : view.points) columns.add8(steps24(p.*kAxes[axis], box[axis]));
  for (const CloudPoint& p : view.points) columns.add8(groups.of(p));
  return columns.text();
}

/// Points a frame, in order: [frame, count], ...
json frame_runs(const std::vector<CloudPoint>& points) {
  json out = json::array();
  for (std::size_t begin = 0; begin < points.size();) {
    std::size_t end = begin;
    while (end < points.size() && points[end].frame == points[begin].frame) ++end;
    out.push_back({points[begin].frame, end - begin});
    begin = end;
  }
  return out;
}

json links_json(const CloudView& view) {
  json out = json::object();
  for (const auto& [frame, links] : view.links)
    for (const FrameLink& link : links) out[std::to_string(frame)].push_back({link.sensor, link.href});
  return out;
}

}  // namespace

EvenThinning::EvenThinning(std::int64_t total, std::int64_t max_points)
    : total_(total), kept_max_(std::min(total, max_points)) {
  LIGHTSTRIPE_CHECK(max_points > 0, "a view shows points");
  chosen_ = -1;
}

bool EvenThinning::keep() {
  const std::int64_t at = next_++;
  if (kept_max_ == total_) return true;
  const auto start_of = [&](std::int64_t run) {
    return static_cast<std::int64_t>(static_cast<double>(run) * static_cast<double>(total_) /
                                     static_cast<double>(kept_max_));
  };
  if (at == start_of(run_)) {
    const auto length = static_cast<std::uint64_t>(start_of(run_ + 1) - at);
    chosen_ = at + static_cast<std::int64_t>(scatter_bits(static_cast<std::uint64_t>(run_)) % length);
    ++run_;
  }
  return at == chosen_;
}

CloudView view_of_cloud(const std::filesystem::path& cloud, const FrameDeviation& deviation,
                        std::int64_t max_points) {
  CloudReader reader(cloud);
  CloudView view;
  view.title = cloud.filename().string();
  view.total = reader.num_points();
  view.origin = reader.origin();
  EvenThinning thinning(view.total, max_points);
  std::vector<CloudPoint> frame;
  while (reader.next_frame(frame)) {
    const std::vector<float> deviations = deviation ? deviation(frame) : std::vector<float>{};
    for (std::size_t i = 0; i < frame.size(); ++i) {
      if (!thinning.keep()) continue;
      view.points.push_back(frame[i]);
      if (deviation) view.deviation_mm.push_back(deviations[i]);
    }
  }
  return view;
}

std::vector<std::int64_t> frames_shown(const CloudView& view) {
  std::vector<std::int64_t> out;
  for (const CloudPoint& p : view.points)
    if (out.empty() || out.back() != p.frame) out.push_back(p.frame);
  return out;
}

std::string cloud_view_html(const CloudView& view) {
  LIGHTSTRIPE_CHECK(view.deviation_mm.empty() || view.deviation_mm.size() == view.points.size(),
                    "one deviation a point, or none");
  const std::array<Span, 3> box = extent(view.points);
  Groups groups;
  json data{{"title", view.title},
            {"count", view.points.size()},
            {"total", view.total},
            {"sensors", view.sensors},
            {"nominal", view.nominal},
            {"deviation", !view.deviation_mm.empty()},
            {"box",
             {span_json(box[0], view.origin.x()), span_json(box[1], view.origin.y()),
              span_json(box[2], view.origin.z())}},
            {"frames", frame_runs(view.points)},
            {"links", links_json(view)}};
  const std::string binary = binary_columns(view, box, groups, data);
  data["groups"] = groups.names;
  return assemble_page({.title = view.title + " - lightstripe view",
                        .name = "view",
                        .libraries = {"three.js", "OrbitControls.js"},
                        .data = std::move(data),
                        .binary = binary});
}

}  // namespace lightstripe
