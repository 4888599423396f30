// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A page of facts, tables and line charts, for reports that need no script of their own.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace lightstripe {

/// In y: the line breaks here.
inline constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

struct ChartLine {
  std::string name;          ///< in the legend; empty: not named
  std::vector<double> x, y;  ///< kNoValue in y breaks the line
  std::vector<double> half;  ///< half width of a band about the line; empty: none
  bool dots = false;         ///< points instead of a line
};

struct LineChart {
  std::string title, x_name, y_name;
  std::vector<ChartLine> lines;
  std::vector<double> limits;  ///< levels drawn across
  bool equal_scales = false;   ///< a millimetre is as long to the right as upwards
};

struct ChartsPage {
  std::string title;
  std::string verdict;              ///< one sentence under the title
  std::optional<bool> good;         ///< colours the verdict; nothing: neither good nor bad
  std::vector<std::string> header;  ///< of the table
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> notes;  ///< under the table
  std::vector<LineChart> charts;
};

/// The whole page: one file, no network.
std::string charts_page_html(const ChartsPage& page);

}  // namespace lightstripe
