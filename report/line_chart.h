// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A small line chart as an <svg> element, with axes and bands.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace lightstripe {

struct ChartLine {
  std::string name;
  std::string colour = "#1f6fb2";
  std::vector<double> x, y;  ///< a NaN in y breaks the line
  std::vector<double> half;  ///< half width of a band about the line; empty: none
  bool dots = false;         ///< points instead of a line
};

struct LineChart {
  std::string title, x_name, y_name;
  std::vector<ChartLine> lines;
  std::optional<double> limit;  ///< a level drawn across
};

std::string line_chart_svg(const LineChart& chart, int width_px = 620, int height_px = 320);

}  // namespace lightstripe
