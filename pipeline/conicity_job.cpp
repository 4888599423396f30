// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/conicity_job.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/counted.h"
#include "core/error.h"
#include "core/robust.h"
#include "io/atomic_file.h"
#include "io/csv_reader.h"
#include "io/nominal_outlines.h"
#include "io/output_guard.h"
#include "measure/profile_formats.h"
#include "pipeline/conicity_table.h"
#include "pipeline/measure_input.h"
#include "pipeline/recorded_profile.h"
#include "pipeline/run_record.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

constexpr std::size_t kFewestPoints = 30;
constexpr double kSpacingMm = 0.05;  // along an outline

/// Points of a source and whether they were measured.
struct Source {
  std::vector<Vector2d> points;  ///< z up; a wheel's is its radius
  bool measured = false;
  bool own_level = false;  ///< z = 0 means something: csv
};

bool is_csv(const std::string& name) { return name.ends_with(".csv") || name.ends_with(".CSV"); }

std::vector<Vector2d> read_csv_points(const std::string& path) {
  CsvReader csv(path, {"y_mm", "z_mm"});
  std::vector<Vector2d> points;
  while (csv.next()) points.emplace_back(csv.number(0), csv.number(1));
  return points;
}

Source read_source(const std::string& source, ObjectKind kind) {
  Source out;
  out.measured = true;
  if (is_csv(source)) {
    out.points = read_csv_points(source);
    out.own_level = true;
  } else if (const auto format = profile_format(source)) {
    out.points = read_recorded(source, *format, kind).points;
  } else {
    const NominalProfile nominal = read_nominal_profile(source);
    if (nominal.kind != kind_name(kind))
      throw Error(source, "is not the outline of a " + kind_name(kind), "give a " + kind_name(kind));
    for (const OutlineSample& point : sample(nominal.outline, kSpacingMm))
      if (point.normal.y() > 0.02) out.points.push_back(point.position);
    out.measured = false;
  }
  if (out.points.size() < kFewestPoints)
    throw Error(source, "has " + counted(out.points.size(), "point"), "give a profile of 30 or more");
  if (out.points.front().x() > out.points.back().x()) std::reverse(out.points.begin(), out.points.end());
  return out;
}

/// An outline's passage may begin anywhere.
void sort_by_place(std::vector<Vector2d>& points) {
  std::sort(points.begin(), points.end(), [](const Vector2d& a, const Vector2d& b) { return a.x() < b.x(); });
}

/// Median height of the points between two places.
std::optional<double> height_between(const std::vector<Vector2d>& points, double from, double to) {
  std::vector<double> heights;
  for (const Vector2d& p : points)
    if (p.x() >= from && p.x() <= to) heights.push_back(p.y());
  if (heights.empty()) return std::nullopt;
  return upper_median(heights);
}

/// Height at a place, straight between its neighbours.
std::optional<double> height_at(const std::vector<Vector2d>& points, double y) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Vector2d &a = points[i - 1], &b = points[i];
    if ((a.x() - y) * (b.x() - y) <= 0 && a.x() != b.x())
      return a.y() + (y - a.x()) / (b.x() - a.x()) * (b.y() - a.y());
  }
  return std::nullopt;
}

/// As a surface in the track: the flange hangs down, at negative y.
void hang_wheel(std::vector<Vector2d>& points, const std::string& source) {
  const auto left = height_between(points, -60, -50), right = height_between(points, 50, 60),
             tread = height_between(points, -3, 3);
  if (!tread)
    throw Error(source, "has no points about y = 0",
                "count y from the tread datum, 70 mm from the wheel's back");
  const double at_left = left ? std::abs(*left - *tread) : 0,
               at_right = right ? std::abs(*right - *tread) : 0;
  if (std::max(at_left, at_right) < 15)
    throw Error(source, "shows no flange 50 to 60 mm from y = 0",
                "give the whole wheel, y from the tread datum");
  if (at_right > at_left) {
    for (Vector2d& p : points) p.x() = -p.x();
    std::reverse(points.begin(), points.end());
  }
  if ((at_right > at_left ? *right : *left) > *tread)
    for (Vector2d& p : points) p.y() = -p.y();
}

/// The flange's face and the tread only: behind the tip and beyond the chamfer nothing rolls.
void cut_wheel(std::vector<Vector2d>& points) {
  constexpr double kFieldMm = 58;
  const auto tip = std::min_element(points.begin(), points.end(), [](const Vector2d& a, const Vector2d& b) {
    return (a.x() < -30 ? a.y() : 1e300) < (b.x() < -30 ? b.y() : 1e300);
  });
  points.erase(points.begin(), tip);
  std::erase_if(points, [&](const Vector2d& p) { return p.x() > kFieldMm; });
}

RunningSurface surface_of(const Source& source, const std::string& name, std::optional<double> sigma_mm,
                          double correlation_mm) {
  if (source.points.size() < kFewestPoints)
    throw Error(name, "has less than 30 points where wheels and rails touch", "give a denser profile");
  if (!source.measured) return RunningSurface::exact(source.points);
  SmoothingOptions smoothing;
  smoothing.sigma_mm = sigma_mm;
  smoothing.correlation_mm = correlation_mm;
  return RunningSurface::measured(source.points, smoothing);
}

/// The upper part of a rail's points, z up, the gauge side at negative y.
void cut_rail(std::vector<Vector2d>& points, double depth_mm) {
  constexpr double kBelowMm = 2;  // the gauge point's depth
  double top = -1e300;
  for (const Vector2d& p : points) top = std::max(top, p.y());
  std::erase_if(points, [&](const Vector2d& p) { return p.y() < top - depth_mm - kBelowMm; });
}

void lean_inwards(std::vector<Vector2d>& points, double inclination) {
  if (inclination == 0) return;
  const Eigen::Rotation2Dd turn(std::atan(1 / inclination));
  for (Vector2d& p : points) p = turn * p;
}

double top_of(const std::vector<Vector2d>& points) {
  double top = -1e300;
  for (const Vector2d& p : points) top = std::max(top, p.y());
  return top;
}

void check_job(const ConicityJob& job) {
  if (!(job.options.from_mm > 0 && job.options.from_mm <= job.options.to_mm))
    throw Error("--from, --to", "are no range of amplitudes", "give 0 < from <= to");
  guard_outputs({job.wheel, job.wheel_right, job.rail, job.rail_right},
                {job.output, job.contacts, job.report});
}

}  // namespace

RollingProfile read_rolling_wheel(const std::string& source, const ConicityJob& job,
                                  std::optional<double> sigma_mm) {
  Source read = read_source(source, ObjectKind::kWheel);
  if (!read.measured) sort_by_place(read.points);
  hang_wheel(read.points, source);
  const auto datum = height_at(read.points, 0);
  if (!datum) throw Error(source, "has no point at y = 0", "count y from the tread datum");
  cut_wheel(read.points);
  for (Vector2d& p : read.points) p.y() -= *datum;
  const RunningSurface rough = surface_of(read, source, sigma_mm, job.correlation_mm);
  // The datum of the smooth surface: one noisy point must not lift a whole wheel.
  const double level = rough.table().at(0);
  for (Vector2d& p : read.points) p.y() -= level;
  RollingProfile out{source, surface_of(read, source, sigma_mm, job.correlation_mm), 0, 0};
  // A csv's own zero tells its radius; levels that differ by scatter only are one.
  const double offset = -(*datum + level);
  if (read.own_level && std::abs(offset) > 0.02) out.radius_mm = offset;
  return out;
}

RollingProfile read_rolling_rail(const std::string& source, const ConicityJob& job,
                                 std::optional<double> sigma_mm) {
  constexpr double kOwnLevelMm = 1;
  Source read = read_source(source, ObjectKind::kRail);
  if (!read.measured) lean_inwards(read.points, job.inclination);
  cut_rail(read.points, job.gauge_point_mm);
  if (!read.measured) sort_by_place(read.points);
  const double top = top_of(read.points);
  // A csv that lies near z = 0 counts from its own running level, as the files of UIC 519 do.
  const double level = read.own_level && std::abs(top) < kOwnLevelMm ? 0.0 : top;
  const auto face = gauge_face_of(read.points, level, job.gauge_point_mm);
  if (!face)
    throw Error(source,
                fmt::format("ends less than {} mm below the top on the gauge side", job.gauge_point_mm),
                "give the whole head, the gauge side at negative y");
  return {source, surface_of(read, source, sigma_mm, job.correlation_mm), 0, *face};
}

Conicity run_conicity(const ConicityJob& job) {
  check_job(job);
  const auto other = [](const std::string& right, const std::string& left) {
    return right.empty() ? left : right;
  };
  const RollingProfile left_wheel = read_rolling_wheel(job.wheel, job, job.wheel_sigma_mm);
  const RollingProfile left_rail = read_rolling_rail(job.rail, job, job.rail_sigma_mm);
  const std::array<RollingProfile, kSides> wheels{
      left_wheel, read_rolling_wheel(other(job.wheel_right, job.wheel), job, job.wheel_sigma_mm)};
  const std::array<RollingProfile, kSides> rails{
      left_rail, read_rolling_rail(other(job.rail_right, job.rail), job, job.rail_sigma_mm)};
  Conicity conicity = equivalent_conicity(wheels, rails, job.options);
  if (!conicity.usable()) return conicity;
  write_file(job.output, conicity_table(conicity));
  if (!job.contacts.empty()) write_file(job.contacts, contact_table(conicity));
  return conicity;
}

std::string conicity_at_3_mm_text(const Conicity& conicity) {
  if (!conicity.at_3_mm) return "not known";
  const double sigma = conicity.at_3_mm_sigma.value_or(0);
  const std::string value = fmt::format("{:.4f}", *conicity.at_3_mm);
  return sigma > 0 ? value + fmt::format(", sigma {:.4f}", std::max(sigma, 1e-4)) : value;
}

}  // namespace lightstripe
