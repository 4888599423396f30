// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/charts_page.h"

#include "report/page.h"

namespace lightstripe {
namespace {

using nlohmann::json;

json numbers(const std::vector<double>& values) {
  json out = json::array();
  for (const double value : values) out.push_back(rounded(value, 6));
  return out;
}

json chart_json(const LineChart& chart) {
  json lines = json::array();
  for (const ChartLine& line : chart.lines)
    lines.push_back({{"name", line.name},
                     {"x", numbers(line.x)},
                     {"y", numbers(line.y)},
                     {"half", numbers(line.half)},
                     {"dots", line.dots}});
  return {{"title", chart.title}, {"x_name", chart.x_name},          {"y_name", chart.y_name},
          {"lines", lines},       {"limits", numbers(chart.limits)}, {"equal_scales", chart.equal_scales}};
}

}  // namespace

std::string charts_page_html(const ChartsPage& page) {
  json charts = json::array();
  for (const LineChart& chart : page.charts) charts.push_back(chart_json(chart));
  return assemble_page({.title = page.title,
                        .name = "charts",
                        .libraries = {"chart.js"},
                        .data = {{"title", page.title},
                                 {"verdict", page.verdict},
                                 {"good", page.good ? json(*page.good) : json(nullptr)},
                                 {"header", page.header},
                                 {"rows", page.rows},
                                 {"notes", page.notes},
                                 {"charts", charts}}});
}

}  // namespace lightstripe
