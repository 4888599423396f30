// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/outside_range.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/counted.h"

namespace lightstripe {
namespace {

/// The range with the lines that lie outside for certain, rounded outwards.
std::string wider_range(const Sensor& sensor, const OutsideRange& outside) {
  constexpr double kStep_mm = 5;
  const double nearest =
      std::min(sensor.depth_range_mm[0], kStep_mm * (std::ceil(outside.nearest_mm / kStep_mm) - 1));
  const double farthest =
      std::max(sensor.depth_range_mm[1], kStep_mm * (std::floor(outside.farthest_mm / kStep_mm) + 1));
  return fmt::format("[{:.0f}, {:.0f}]", nearest, farthest);
}

}  // namespace

std::vector<std::string> outside_range_texts(const std::vector<OutsideRange>& all, const Rig& rig) {
  std::vector<std::string> texts;
  for (const OutsideRange& outside : all) {
    const Sensor& sensor = rig.sensors[static_cast<std::size_t>(outside.sensor)];
    std::string text =
        fmt::format("{} of {} may lie outside its depth_range [{:.0f}, {:.0f}] and {} left out",
                    counted(outside.points, "stripe point"), sensor.name, sensor.depth_range_mm[0],
                    sensor.depth_range_mm[1], noun_of(outside.points, "is", "are"));
    if (outside.farthest_mm > 0)
      text += fmt::format(
          ", for certain from {:.0f} to {:.0f} mm; depth_range: {} in rig.yaml keeps these, boards there "
          "would make them accurate",
          outside.nearest_mm, outside.farthest_mm, wider_range(sensor, outside));
    else
      text +=
          "; show all laser planes' lines beside each other, or give the depth_range of rig.yaml in which "
          "the object lies";
    texts.push_back(std::move(text));
  }
  return texts;
}

std::string why_all_missed(const ScanSummary& summary, const std::vector<std::string>& outside_range) {
  std::string text =
      fmt::format("lines were seen in {}, but none of their {} has a certain place (nothing is written); ",
                  counted(summary.frames, "frame"), counted(summary.rays_missed, "point"));
  for (const std::string& sentence : outside_range) text += sentence + "; ";
  return text + "look at a frame with `lightstripe extract --overlay`: which line is which laser's?";
}

}  // namespace lightstripe
