// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/measure_report.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "io/images.h"
#include "pipeline/measurement_table.h"
#include "pipeline/quantity_text.h"
#include "report/calibration_error_text.h"
#include "report/frame_thumbnails.h"
#include "report/page.h"
#include "report/section_drawing.h"

namespace lightstripe {
namespace {

using nlohmann::json;

constexpr std::size_t kWorst = 15;  // places in the table

struct MeasureReport {
  const MeasureJob& job;
  const MeasureResult& result;
  const MeasureReportPlaces& places;
};

std::vector<std::string> quantities(const MeasureReport& report) {
  std::vector<std::string> names = estimate_names(report.job.kind);
  for (const std::string& name : report.result.extra_columns) names.push_back(name);
  return names;
}

Bounds drawn_bounds(const MeasureReport& report, const std::string& name) {
  const double gap = report.job.options.max_overlap_gap_mm;
  if (name == "overlap_gap" || name == "right_overlap_gap") return {-gap, gap};
  return bounds_of(name, report.job.limits);
}

json optional_json(const std::optional<double>& value, int decimals) {
  return value ? rounded(*value, decimals) : json(nullptr);
}

/// One quantity: its texts, limits, spread, and a value, a sigma and a reason for each frame.
json quantity_json(const MeasureReport& report, const std::string& name) {
  const QuantityText text = quantity_text(name);
  const Spread spread = spread_of(report.result.rows, name);
  const Bounds bounds = drawn_bounds(report, name);
  json values = json::array(), sigmas = json::array(), reasons = json::array();
  for (const MeasuredFrame& row : report.result.rows) {
    const Estimate* estimate = find_estimate(row, name);
    const bool known = estimate && estimate->value;
    values.push_back(known ? rounded(*estimate->value, 5) : json(nullptr));
    sigmas.push_back(known ? optional_json(estimate->sigma, 5) : json(nullptr));
    reasons.push_back(known || !estimate ? "" : estimate->reason);
  }
  return {{"name", name},
          {"label", text.label},
          {"unit", text.unit},
          {"decimals", text.decimals},
          {"main", find_estimate(report.result.rows.front(), name) != nullptr},
          {"known", spread.known},
          {"lowest", rounded(spread.low, 5)},
          {"mean", rounded(spread.mean, 5)},
          {"highest", rounded(spread.high, 5)},
          {"low", bounds.low ? json(*bounds.low) : json(nullptr)},
          {"high", bounds.high ? json(*bounds.high) : json(nullptr)},
          {"values", values},
          {"sigmas", sigmas},
          {"reasons", reasons}};
}

/// What says that a place is worse than another: the wear that grows.
constexpr const char* kWear[] = {"vertical_wear",       "side_wear",       "corner45_wear",
                                 "right_vertical_wear", "right_side_wear", "right_corner45_wear",
                                 "tread_wear",          "hollow"};

/// The largest wear of a frame that lies beyond its own error and beyond what the eye would call wear; 0:
/// none.
double wear_of(const MeasuredFrame& row) {
  constexpr double kLeastMm = 0.05, kSigmas = 3;
  double worst = 0;
  for (const char* name : kWear) {
    const Estimate* estimate = find_estimate(row, name);
    if (!estimate || !estimate->value) continue;
    if (*estimate->value > std::max(kLeastMm, kSigmas * estimate->sigma.value_or(0)))
      worst = std::max(worst, *estimate->value);
  }
  return worst;
}

/// Frames that fail a limit, then those that are worn; none where nothing is worse than the rest.
std::vector<std::size_t> worst_first(const MeasureReport& report) {
  std::vector<std::pair<double, std::size_t>> bad;
  for (std::size_t i = 0; i < report.result.rows.size(); ++i) {
    const double badness = wear_of(report.result.rows[i]) + (report.result.verdicts[i] == "fail" ? 1e6 : 0);
    if (badness > 0) bad.emplace_back(badness, i);
  }
  std::stable_sort(bad.begin(), bad.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < std::min(kWorst, bad.size()); ++k) order.push_back(bad[k].second);
  return order;
}

/// The worst places and some evenly along the track, in the track's order.
std::set<std::size_t> drawn_sections(const MeasureReport& report, const std::vector<std::size_t>& worst) {
  constexpr std::size_t kEven = 12;
  std::set<std::size_t> shown(worst.begin(), worst.end());
  for (std::size_t k = 0; k < kEven; ++k) shown.insert(k * (report.result.rows.size() - 1) / (kEven - 1));
  return shown;
}

json points_json(const std::vector<Eigen::Vector2d>& points) {
  json out = json::array();
  for (const Eigen::Vector2d& p : points) out.push_back(rounded(p.x(), 2)), out.push_back(rounded(p.y(), 2));
  return out;
}

/// Flat lists of coordinates: a section has a thousand points.
json drawing_json(const SectionDrawing& drawing) {
  json lines = json::array(), whiskers = json::array();
  for (const auto& line : drawing.reference) lines.push_back(points_json(line));
  for (const auto& w : drawing.whiskers)
    for (const double v : {w.foot.x(), w.foot.y(), w.end.x(), w.end.y()}) whiskers.push_back(rounded(v, 2));
  json differences = json::array();
  for (const auto& w : drawing.whiskers) differences.push_back(rounded(w.difference, 3));
  return {{"reference", lines},
          {"points", points_json(drawing.points)},
          {"whiskers", whiskers},
          {"differences", differences},
          {"enlarged", drawing.enlarged},
          {"box", {drawing.low.x(), drawing.low.y(), drawing.high.x(), drawing.high.y()}}};
}

using Thumbnails = std::map<std::int64_t, std::vector<FrameThumbnail>>;

Thumbnails thumbnails_of(const MeasureReport& report, const std::set<std::size_t>& shown) {
  if (report.places.scan_file.empty()) return {};
  std::vector<const Profile*> profiles;
  for (const std::size_t i : shown) profiles.push_back(&report.result.input.profiles[i]);
  return frame_thumbnails(report.places.scan_file, report.job.rig, report.places.page, profiles);
}

/// Of a track: the left rail, then the right one.
json section_json(const MeasureReport& report, std::size_t i, const Thumbnails& thumbnails) {
  const MeasuredFrame& row = report.result.rows[i];
  const Profile& profile = report.result.input.profiles[i];
  json drawings = json::array(), pictures = json::array();
  drawings.push_back(
      drawing_json(draw_section(profile, row.registration, report.result.references.at(row.travel))));
  if (row.right_registration)
    drawings.push_back(
        drawing_json(draw_section(profile, *row.right_registration, report.result.references.right())));
  if (const auto found = thumbnails.find(row.frame); found != thumbnails.end())
    for (const FrameThumbnail& one : found->second)
      pictures.push_back({{"sensor", one.sensor},
                          {"href", one.href},
                          {"picture", one.jpeg.empty() ? "" : "data:image/jpeg;base64," + base64(one.jpeg)}});
  return {{"row", i}, {"drawings", drawings}, {"pictures", pictures}};
}

/// Of the drawn sections: tan gamma_e over the amplitude.
json conicity_json(const MeasureReport& report, const std::set<std::size_t>& shown) {
  json curves = json::array();
  for (const std::size_t i : shown) {
    json amplitudes = json::array(), values = json::array();
    for (const ConicityRow& at : report.result.rows[i].conicity) {
      amplitudes.push_back(rounded(at.y_mm, 2));
      values.push_back(optional_json(at.tan_gamma_e, 4));
    }
    if (!amplitudes.empty()) curves.push_back({{"row", i}, {"y", amplitudes}, {"values", values}});
  }
  return curves;
}

json run_out_json(const Estimate& run_out) {
  return {{"value", optional_json(run_out.value, 4)},
          {"sigma", optional_json(run_out.sigma, 4)},
          {"reason", run_out.reason}};
}

json rows_json(const MeasureReport& report) {
  json frames = json::array(), travel = json::array(), status = json::array();
  for (const MeasuredFrame& row : report.result.rows) {
    frames.push_back(row.frame);
    travel.push_back(rounded(row.travel, 4));
    status.push_back(row.status);
  }
  return {{"frame", frames}, {"travel", travel}, {"status", status}, {"verdict", report.result.verdicts}};
}

/// Whether the sigmas count what the calibration errs by.
json calibration_sentences(const MeasureReport& report) {
  json out = json::array();
  for (const Message& one :
       describe_calibration_error(report.result.rig, report.result.calibration, report.job.profiles).list)
    out.push_back(one.text);
  return out;
}

json report_data(const MeasureReport& report) {
  const auto& rows = report.result.rows;
  const std::vector<std::size_t> worst = worst_first(report);
  const std::set<std::size_t> shown = drawn_sections(report, worst);
  const Thumbnails thumbnails = thumbnails_of(report, shown);
  json named = json::array(), sections = json::array();
  for (const std::string& name : quantities(report)) named.push_back(quantity_json(report, name));
  for (const std::size_t i : shown) sections.push_back(section_json(report, i, thumbnails));
  const bool rail = report.job.kind == ObjectKind::kRail;
  json data{{"object", rail ? "Rail" : "Wheel"},
            {"rotary", sections_are_radial(report.result.input.profiles)},
            {"nominal", report.result.references.at(rows.front().travel).name()},
            {"profiles", report.job.profiles.string()},
            {"view", report.places.view},
            {"ok", report.result.num_ok},
            {"warnings", report.result.warnings},
            {"calibration_error", calibration_sentences(report)},
            {"rows", rows_json(report)},
            {"quantities", named},
            {"worst", worst},
            {"conicity", conicity_json(report, shown)},
            {"sections", sections}};
  if (report.result.run_out)
    data["run_out"] = {{"radial", run_out_json(report.result.run_out->radial)},
                       {"axial", run_out_json(report.result.run_out->axial)}};
  return data;
}

}  // namespace

std::string measure_report_html(const MeasureJob& job, const MeasureResult& result,
                                const MeasureReportPlaces& places) {
  return assemble_page({.title = "lightstripe measurements",
                        .name = "measure",
                        .libraries = {"chart.js"},
                        .data = report_data({job, result, places})});
}

}  // namespace lightstripe
