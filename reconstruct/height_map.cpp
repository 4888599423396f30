// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/height_map.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "core/error.h"
#include "reconstruct/cloud.h"
#include "reconstruct/cloud_spacing.h"

namespace lightstripe {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr double kMaxPixels = 268435456;  // 2^28
constexpr double kUsualSpacings = 3, kUsualSteps = 1.5;
constexpr double kSteepest = 2;  // height over travel between two frames: above, an edge

/// Where a point stands on the map.
struct MapPoint {
  double column = 0, row = 0, height = 0;  ///< mm; rotary: column in degrees
};

class MapFrame {
 public:
  MapFrame(const Motion& motion, const Eigen::Vector3d& origin)
      : motion_(motion), origin_(origin), rotary_(motion.type == MotionType::kRotary) {
    const Eigen::Vector3d& axis = motion.axis_direction;
    zero_ = Eigen::Vector3d::UnitZ() - axis.z() * axis;
    if (zero_.norm() < 1e-6) zero_ = Eigen::Vector3d::UnitX() - axis.x() * axis;
    zero_.normalize();
    quarter_ = axis.cross(zero_);
  }
  bool rotary() const { return rotary_; }
  MapPoint place(const CloudPoint& p) const {
    if (!rotary_) return {p.x + origin_.x(), p.y + origin_.y(), p.z};
    const Eigen::Vector3d arm = Eigen::Vector3d(p.x, p.y, p.z) + origin_ - motion_.axis_point;
    const double u = arm.dot(motion_.axis_direction), a = arm.dot(zero_), b = arm.dot(quarter_);
    const double angle = std::atan2(b, a) * 180 / std::numbers::pi;
    return {angle < 0 ? angle + 360 : angle, u, std::hypot(a, b)};
  }

 private:
  const Motion& motion_;
  Eigen::Vector3d origin_;
  bool rotary_;
  Eigen::Vector3d zero_, quarter_;
};

struct Extent {
  double column_low = std::numeric_limits<double>::max(), column_high = -column_low;
  double row_low = column_low, row_high = -column_low;
  double radius = 0;  ///< mean
};

Extent extent_of(const std::filesystem::path& cloud, const MapFrame& frame_of_map) {
  CloudReader reader(cloud);
  std::vector<CloudPoint> frame;
  Extent out;
  double sum = 0;
  while (reader.next_frame(frame))
    for (const CloudPoint& point : frame) {
      const MapPoint p = frame_of_map.place(point);
      out.column_low = std::min(out.column_low, p.column),
      out.column_high = std::max(out.column_high, p.column);
      out.row_low = std::min(out.row_low, p.row), out.row_high = std::max(out.row_high, p.row);
      sum += p.height;
    }
  out.radius = sum / static_cast<double>(std::max<std::int64_t>(1, reader.num_points()));
  return out;
}

HeightMap empty_map(const Extent& extent, bool rotary, double raster_mm) {
  HeightMap map;
  map.rotary = rotary;
  double columns = std::floor((extent.column_high - extent.column_low) / raster_mm + 0.5) + 1;
  map.column_first = extent.column_low, map.column_step = raster_mm;
  if (rotary) {  // a whole turn, so that the last column is the first one's neighbour
    columns = std::max(1.0, std::round(2 * std::numbers::pi * extent.radius / raster_mm));
    map.column_first = 0, map.column_step = 360 / columns;
  }
  const double rows = std::floor((extent.row_high - extent.row_low) / raster_mm + 0.5) + 1;
  if (columns * rows > kMaxPixels)
    throw Error("--raster", fmt::format("a map of {:.0f} x {:.0f} pixels is too large", columns, rows),
                "give a larger raster, or drop stray points by --filter outliers");
  map.width = static_cast<int>(columns), map.height = static_cast<int>(rows);
  map.row_first = extent.row_low, map.row_step = raster_mm;
  const auto pixels = static_cast<std::size_t>(columns * rows);
  map.heights.assign(pixels, kNaN);
  map.intensity.assign(pixels, kNaN);
  map.sigma.assign(pixels, kNaN);
  return map;
}

/// What one stripe says on one row of the raster.
struct Sample {
  double column = 0, height = 0;
  float intensity = 0, sigma = 0;
  bool there = false, joined = false;  ///< joined: the frame before has the same place
};
using RowSamples = std::vector<Sample>;

Sample between(const Sample& a, const Sample& b, double part) {
  const auto mix = [&](auto p, auto q) { return static_cast<decltype(p)>(p + part * (q - p)); };
  return {mix(a.column, b.column),
          mix(a.height, b.height),
          mix(a.intensity, b.intensity),
          mix(a.sigma, b.sigma),
          true,
          false};
}

class MapMaker {
 public:
  MapMaker(HeightMap& map, const HeightMapOptions& options, double max_column_gap)
      : map_(map), options_(options), max_column_gap_(max_column_gap), weights_(map.heights.size(), 0.0F) {}

  /// The frame's rows joined to those of the same sensor's frame before.
  void add(int sensor, RowSamples rows) {
    RowSamples& before = before_[sensor];
    if (before.empty()) before.resize(rows.size());
    for (std::size_t row = 0; row < rows.size(); ++row) join(row, before[row], rows[row]);
    before = std::move(rows);
  }
  void finish() {
    for (auto& [sensor, rows] : before_)
      for (std::size_t row = 0; row < rows.size(); ++row)
        if (rows[row].there) reach_out(row, rows[row], +1);
  }

 private:
  double turn(double column) const {  // the shorter way round
    return map_.rotary ? column - 360 * std::round(column / 360) : column;
  }

  void join(std::size_t row, Sample& a, Sample& b) {
    const double way = turn(b.column - a.column);
    if (a.there && b.there && std::abs(way) <= max_column_gap_) {
      b.joined = true;
      fill_between(row, a, b, way);
    } else {
      if (a.there) reach_out(row, a, +1);
      if (b.there) reach_out(row, b, -1);
    }
  }

  /// Columns in [a, b).
  void fill_between(std::size_t row, const Sample& a, const Sample& b, double way) {
    const double sign = way < 0 ? -1 : 1, begin = (a.column - map_.column_first) / map_.column_step,
                 end = begin + way / map_.column_step;
    const double mm_a_column = map_.row_step;
    const bool edge = std::abs(b.height - a.height) > kSteepest * std::abs(end - begin) * mm_a_column;
    const double first = sign > 0 ? std::ceil(begin - 1e-9) : std::floor(begin + 1e-9);
    for (double column = first; sign * (end - column) > 1e-9; column += sign) {
      const double part = std::clamp((column - begin) / (end - begin), 0.0, 1.0);
      put(row, column, edge ? (part < 0.5 ? a : b) : between(a, b, part));
    }
  }

  /// The first or last sample of a run also stands for the column whose middle lies just beyond it.
  void reach_out(std::size_t row, const Sample& sample, int way) {
    const double at = (sample.column - map_.column_first) / map_.column_step, column = std::round(at);
    if ((way > 0 && column >= at - 1e-9) || (way < 0 && column < at - 1e-9)) put(row, column, sample);
  }

  void put(std::size_t row, double column, const Sample& sample) {
    if (map_.rotary) column -= map_.width * std::floor(column / map_.width);
    if (column < 0 || column >= map_.width) return;
    const std::size_t at = row * static_cast<std::size_t>(map_.width) + static_cast<std::size_t>(column);
    float weight = 1 / std::max(1e-6F, sample.sigma * sample.sigma);
    const float difference = static_cast<float>(sample.height) - map_.heights[at];
    if (std::abs(difference) <= options_.same_surface_mm) {
      const float part = weight / (weight + weights_[at]);
      map_.heights[at] += part * difference;
      map_.intensity[at] += part * (sample.intensity - map_.intensity[at]);
      map_.sigma[at] += part * (sample.sigma - map_.sigma[at]);
      weights_[at] += weight;
    } else if (!(difference < 0)) {  // higher, or the first
      map_.heights[at] = static_cast<float>(sample.height);
      map_.intensity[at] = sample.intensity;
      map_.sigma[at] = sample.sigma;
      weights_[at] = weight;
    }
  }

  HeightMap& map_;
  const HeightMapOptions& options_;
  double max_column_gap_;
  std::vector<float> weights_;
  std::map<int, RowSamples> before_;
};

/// Where the raster's rows cross the way from one point to the next; the highest place of each row stays.
void sample_segment(const HeightMap& map, const Sample& a, double row_a, const Sample& b, double row_b,
                    RowSamples& rows) {
  const double low = std::min(row_a, row_b), high = std::max(row_a, row_b);
  for (double row = std::ceil(low - 1e-9); row <= high + 1e-9 && row < map.height; ++row) {
    const double part = high > low ? std::clamp((row - row_a) / (row_b - row_a), 0.0, 1.0) : 0.5;
    Sample end = b;
    if (map.rotary)
      end.column = a.column + (b.column - a.column) - 360 * std::round((b.column - a.column) / 360);
    const Sample sample = between(a, end, part);
    Sample& place = rows[static_cast<std::size_t>(std::max(0.0, row))];
    if (!place.there || sample.height > place.height) place = sample;
  }
}

/// The rows of one sensor in one frame.
RowSamples sample_stripes(const HeightMap& map, const MapFrame& frame_of_map,
                          const std::vector<CloudPoint>& frame, int sensor, double max_gap_mm) {
  RowSamples rows(static_cast<std::size_t>(map.height));
  const CloudPoint* before = nullptr;
  Sample last;
  double last_row = 0;
  for (const CloudPoint& point : frame) {
    if (point.sensor != sensor) continue;
    const MapPoint p = frame_of_map.place(point);
    const Sample sample{p.column, p.height, point.intensity, point.sigma, true, false};
    const double row = (p.row - map.row_first) / map.row_step;
    if (before && before->line == point.line &&
        std::hypot(point.x - before->x, point.y - before->y, point.z - before->z) <= max_gap_mm)
      sample_segment(map, last, last_row, sample, row, rows);
    before = &point, last = sample, last_row = row;
  }
  return rows;
}

}  // namespace

HeightMap make_height_map(const std::filesystem::path& cloud, const Motion& motion,
                          const HeightMapOptions& options) {
  LIGHTSTRIPE_CHECK(options.raster_mm > 0, "a raster has a positive step");
  CloudReader reader(cloud);
  const MapFrame frame_of_map(motion, reader.origin());
  const CloudSpacing spacing = cloud_spacing(cloud);
  const Extent extent = extent_of(cloud, frame_of_map);
  if (extent.column_high < extent.column_low)
    throw Error(cloud.string(), "has no points", "reconstruct it again");
  HeightMap map = empty_map(extent, frame_of_map.rotary(), options.raster_mm);
  map.height_origin = map.rotary ? 0 : reader.origin().z();
  const double mm_a_column_unit = map.rotary ? extent.radius * std::numbers::pi / 180 : 1;
  const double max_gap_mm = std::max(kUsualSpacings * spacing.along_stripe_mm, options.bridge_mm);
  MapMaker maker(map, options, kUsualSteps * spacing.between_frames_mm / mm_a_column_unit);
  std::vector<CloudPoint> frame;
  while (reader.next_frame(frame)) {
    std::vector<int> sensors;
    for (const CloudPoint& p : frame)
      if (sensors.empty() || sensors.back() != p.sensor) sensors.push_back(p.sensor);
    std::sort(sensors.begin(), sensors.end());
    sensors.erase(std::unique(sensors.begin(), sensors.end()), sensors.end());
    for (const int sensor : sensors)
      maker.add(sensor, sample_stripes(map, frame_of_map, frame, sensor, max_gap_mm));
  }
  maker.finish();
  return map;
}

}  // namespace lightstripe
