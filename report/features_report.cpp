// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/features_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/counted.h"
#include "report/calibration_error_text.h"
#include "report/charts_page.h"

namespace lightstripe {
namespace {

/// One quantity over all sections; dashes where no section has it.
std::vector<std::string> row_of(const FeaturesResult& result, std::size_t i) {
  const QuantityRecipe& recipe = result.file.measurements[i];
  double low = 1e300, high = -1e300, sum = 0, sigma = 0;
  int known = 0;
  for (const MeasuredFeatures& row : result.rows)
    if (const Estimate& e = row.quantities[i]; e.value) {
      low = std::min(low, *e.value), high = std::max(high, *e.value);
      sum += *e.value, sigma += e.sigma.value_or(0), ++known;
    }
  const auto number = [&](double value) { return known > 0 ? fmt::format("{:.4f}", value) : "-"; };
  const auto limit = [](const std::optional<double>& value) {
    return value ? fmt::format("{:g}", *value) : "-";
  };
  return {recipe.name,  fmt::format("{}", known), number(low),       number(sum / known),
          number(high), number(sigma / known),    limit(recipe.min), limit(recipe.max)};
}

std::string along_the_scan(const AlongRecipe& recipe, const Estimate& e) {
  return recipe.name + " along the scan: " +
         (e.value ? fmt::format("{:.4f} mm, sigma {:.4f} mm", *e.value, e.sigma.value_or(0)) : e.reason);
}

LineChart chart_of(const FeaturesResult& result, std::size_t i) {
  ChartLine line{"", {}, {}, {}, false};
  for (const MeasuredFeatures& row : result.rows) {
    const Estimate& e = row.quantities[i];
    line.x.push_back(row.travel), line.y.push_back(e.value.value_or(kNoValue));
    line.half.push_back(2 * e.sigma.value_or(0));
  }
  const QuantityRecipe& recipe = result.file.measurements[i];
  LineChart chart{recipe.name + " (band: two sigma)", "travel", recipe.name, {line}, {}, false};
  for (const auto& limit : {recipe.min, recipe.max})
    if (limit) chart.limits.push_back(*limit);
  return chart;
}

/// A feature as a thin line over the section.
ChartLine drawn(const ShapeFit& fit, const std::string& name) {
  ChartLine line{name, {}, {}, {}, fit.kind == ShapeFit::Kind::kPoint};
  if (fit.kind == ShapeFit::Kind::kLine) {
    for (const double share : {-1.0, 1.0}) {
      const Eigen::Vector2d p = fit.place + share * fit.half_length_mm * fit.along;
      line.x.push_back(p.x()), line.y.push_back(p.y());
    }
  } else if (fit.kind == ShapeFit::Kind::kPoint) {
    line.x.push_back(fit.parameters(0)), line.y.push_back(fit.parameters(1));
  } else {
    for (int i = 0; i <= 72; ++i) {
      const double angle = i * std::numbers::pi / 36;
      line.x.push_back(fit.parameters(0) + fit.parameters(2) * std::cos(angle));
      line.y.push_back(fit.parameters(1) + fit.parameters(2) * std::sin(angle));
    }
  }
  return line;
}

LineChart section_of_row(const FeaturesResult& result, std::size_t row) {
  ChartLine points{"measured", {}, {}, {}, true};
  for (const ProfilePoint& p : result.profiles[row].points) points.x.push_back(p.u), points.y.push_back(p.v);
  LineChart chart{
      fmt::format("Section of frame {}", result.rows[row].frame), "u, mm", "v, mm", {points}, {}, true};
  for (std::size_t i = 0; i < result.file.features.size(); ++i)
    if (result.rows[row].features[i].known())
      chart.lines.push_back(drawn(result.rows[row].features[i], result.file.features[i].name));
  return chart;
}

}  // namespace

std::string features_report_html(const FeaturesJob& job, const FeaturesResult& result) {
  ChartsPage page{"Features of a section",
                  fmt::format("{} of {} measured completely", result.num_complete,
                              counted(result.rows.size(), "section")),
                  {},
                  {"quantity", "sections", "lowest", "mean", "highest", "mean sigma", "min", "max"},
                  {},
                  {fmt::format("From {}, features of {}.", job.profiles.string(), job.features.string())},
                  {}};
  for (std::size_t i = 0; i < result.file.measurements.size(); ++i) {
    page.rows.push_back(row_of(result, i));
    const auto known = [i](const MeasuredFeatures& row) { return row.quantities[i].value.has_value(); };
    if (std::any_of(result.rows.begin(), result.rows.end(), known))
      page.charts.push_back(chart_of(result, i));
  }
  for (const Message& one : describe_calibration_error(result.rig, result.calibration, job.profiles).list)
    page.notes.push_back(one.text);
  for (std::size_t i = 0; i < result.along.size(); ++i)
    page.notes.push_back(along_the_scan(result.file.along[i], result.along[i]));
  for (const std::size_t row : {std::size_t{0}, result.rows.size() / 2, result.rows.size() - 1})
    page.charts.push_back(section_of_row(result, row));
  return charts_page_html(page);
}

}  // namespace lightstripe
