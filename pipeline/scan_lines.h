// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What a scan's lines were seen in and how wide they are, for its record and for people.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/images.h"
#include "reconstruct/scanner.h"

namespace lightstripe {

/// Of one sensor; widths in px over all points, from the lines' medians, to 1/16 octave.
struct SensorLines {
  std::string sensor;
  std::optional<Channel> channel;  ///< that its pictures are read in
  std::int64_t points = 0;
  double narrow_px = 0, median_px = 0,
         wide_px = 0;  ///< 5 %, 50 % and 95 % of the points lie on narrower lines
};

/// Adds up line widths, in any order of lines.
class LineWidths {
 public:
  explicit LineWidths(std::size_t sensors) : counts_(sensors) {}
  void add(const LineWidth& line);
  /// Widths of 0 for a sensor without points.
  SensorLines describe(std::size_t sensor, const std::string& name, std::optional<Channel> channel) const;

 private:
  static constexpr int kBins = 16 * 10;  // from 0.5 px on
  std::vector<std::array<std::int64_t, kBins>> counts_;
};

/// "gauge: channel red-laser, lines 3.1 to 7.9 px wide, 4.4 px in the middle".
std::string describe_lines(const SensorLines& lines);

/// The same for the run's record, YAML.
std::string lines_yaml(const std::vector<SensorLines>& lines);

}  // namespace lightstripe
