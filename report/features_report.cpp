// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/features_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "report/line_chart.h"
#include "report/page.h"
#include "report/page_text.h"

namespace lightstripe {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

std::string row_of(const std::string& name, const QuantityRecipe* recipe, int known, double low, double mean,
                   double high, double sigma) {
  const auto limit = [](const std::optional<double>& value) {
    return value ? fmt::format("{:g}", *value) : "";
  };
  return fmt::format(
      "<tr><td>{}</td><td>{}</td><td>{:.4f}</td><td>{:.4f}</td><td>{:.4f}</td><td>{:.4f}</td><td>{}</"
      "td><td>{}</td></tr>",
      html_escaped(name), known, low, mean, high, sigma, recipe ? limit(recipe->min) : "",
      recipe ? limit(recipe->max) : "");
}

std::string table_of(const FeaturesResult& result) {
  std::string out =
      "<table><tr><th></th><th>sections</th><th>lowest</th><th>mean</th><th>highest</th><th>mean "
      "sigma</th><th>min</th><th>max</th></tr>";
  for (std::size_t i = 0; i < result.file.measurements.size(); ++i) {
    double low = 1e300, high = -1e300, sum = 0, sigma = 0;
    int known = 0;
    for (const MeasuredFeatures& row : result.rows)
      if (const Estimate& e = row.quantities[i]; e.value) {
        low = std::min(low, *e.value), high = std::max(high, *e.value);
        sum += *e.value, sigma += e.sigma.value_or(0), ++known;
      }
    if (known > 0)
      out += row_of(result.file.measurements[i].name, &result.file.measurements[i], known, low, sum / known,
                    high, sigma / known);
    else
      out += fmt::format("<tr><td>{}</td><td>0</td></tr>", html_escaped(result.file.measurements[i].name));
  }
  return out + "</table>";
}

std::string along_of(const FeaturesResult& result) {
  std::string out;
  for (std::size_t i = 0; i < result.along.size(); ++i) {
    const Estimate& e = result.along[i];
    out += "<p>" + html_escaped(result.file.along[i].name) + ": " +
           (e.value ? fmt::format("<b>{:.4f}</b> mm, sigma {:.4f}", *e.value, e.sigma.value_or(0))
                    : html_escaped(e.reason)) +
           "</p>";
  }
  return out;
}

std::string chart_of(const FeaturesResult& result, std::size_t i) {
  ChartLine line{"", "#1f6fb2", {}, {}, {}, false};
  for (const MeasuredFeatures& row : result.rows) {
    const Estimate& e = row.quantities[i];
    line.x.push_back(row.travel), line.y.push_back(e.value.value_or(kNothing));
    line.half.push_back(2 * e.sigma.value_or(0));
  }
  const QuantityRecipe& recipe = result.file.measurements[i];
  return line_chart_svg(
      {html_escaped(recipe.name), "travel", "", {line}, recipe.max ? recipe.max : recipe.min}, 420, 240);
}

/// A feature as a thin line over the section.
ChartLine drawn(const ShapeFit& fit, const std::string& name) {
  ChartLine line{name, "#c8401f", {}, {}, {}, fit.kind == ShapeFit::Kind::kPoint};
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

std::string section_of_row(const FeaturesResult& result, std::size_t row) {
  ChartLine points{"", "#888", {}, {}, {}, true};
  for (const ProfilePoint& p : result.profiles[row].points) points.x.push_back(p.u), points.y.push_back(p.v);
  LineChart chart{fmt::format("frame {}", result.rows[row].frame), "u, mm", "v, mm", {points}, {}};
  for (std::size_t i = 0; i < result.file.features.size(); ++i)
    if (result.rows[row].features[i].known())
      chart.lines.push_back(drawn(result.rows[row].features[i], html_escaped(result.file.features[i].name)));
  return line_chart_svg(chart, 620, 360);
}

}  // namespace

std::string features_report_html(const FeaturesJob& job, const FeaturesResult& result) {
  std::string body = fmt::format("<h1>Features</h1><p>{}, {}: {} sections, {} complete.</p>",
                                 html_escaped(job.profiles.string()), html_escaped(job.features.string()),
                                 result.rows.size(), result.num_complete);
  body += table_of(result) + along_of(result) + "<div class=\"strip\">";
  for (std::size_t i = 0; i < result.file.measurements.size(); ++i)
    body += "<figure>" + chart_of(result, i) + "</figure>";
  for (const std::size_t row : {std::size_t{0}, result.rows.size() / 2, result.rows.size() - 1})
    body += "<figure>" + section_of_row(result, row) + "</figure>";
  return page("Features", body + "</div>");
}

}  // namespace lightstripe
