// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/scan_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/yaml_binding.h"

namespace lightstripe {
namespace {

constexpr double kNarrowest = 0.5, kPerOctave = 16;

double width_of(int bin) { return kNarrowest * std::exp2((bin + 0.5) / kPerOctave); }

}  // namespace

void LineWidths::add(const LineWidth& line) {
  const double bin = std::floor(kPerOctave * std::log2(std::max(line.width_px, kNarrowest) / kNarrowest));
  counts_[static_cast<std::size_t>(line.sensor)][static_cast<std::size_t>(std::min(bin, kBins - 1.0))] +=
      line.points;
}

SensorLines LineWidths::describe(std::size_t sensor, const std::string& name,
                                 std::optional<Channel> channel) const {
  SensorLines lines;
  lines.sensor = name;
  lines.channel = channel;
  for (const std::int64_t count : counts_[sensor]) lines.points += count;
  const auto quantile = [&](double share) {
    std::int64_t below = 0;
    for (int bin = 0; bin < kBins; ++bin) {
      below += counts_[sensor][static_cast<std::size_t>(bin)];
      if (below > 0 && static_cast<double>(below) >= share * static_cast<double>(lines.points))
        return width_of(bin);
    }
    return 0.0;
  };
  lines.narrow_px = quantile(0.05);
  lines.median_px = quantile(0.5);
  lines.wide_px = quantile(0.95);
  return lines;
}

std::string describe_lines(const SensorLines& lines) {
  return fmt::format("{}: channel {}, lines {:.1f} to {:.1f} px wide, {:.1f} px in the middle", lines.sensor,
                     enum_name(lines.channel.value_or(Channel::kGray)), lines.narrow_px, lines.wide_px,
                     lines.median_px);
}

std::string lines_yaml(const std::vector<SensorLines>& all) {
  std::string text;
  for (const SensorLines& lines : all) {
    if (!lines.channel) continue;
    text += fmt::format(
        "  - {{sensor: {}, channel: {}, points: {}, stripe_width_px: [{:.2f}, {:.2f}, {:.2f}]}}\n",
        yaml_text(lines.sensor), enum_name(*lines.channel), lines.points, lines.narrow_px, lines.median_px,
        lines.wide_px);
  }
  return text.empty() ? text : "lines:\n" + text;
}

}  // namespace lightstripe
