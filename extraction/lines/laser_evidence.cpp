// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/laser_evidence.h"

#include <algorithm>

#include "extraction/kernels/width_rule.h"

namespace lightstripe {
namespace {

/// Grey levels; what is brighter is no more a line.
constexpr double kEnoughLight = 60;

/// How long and even a line is, in stripe widths.
double even_widths(const DerivativeKernels& kernels, const LineFacts& line) {
  return line.even_length() / std::max(line.width, full_width_of(kernels.sigma));
}

}  // namespace

double light_of_line(const LineFacts& line) {
  const double light = line.colour.known ? line.colour.rise : line.intensity;
  return line.even_length() * std::clamp(light, 0.0, kEnoughLight);
}

bool shows_laser(std::span<const FilteredLines> groups, const EdgeCrowd& edges, double bars, double extent,
                 double least_widths) {
  // Grey levels that a line as long as width + height adds, where as much speaks for other things.
  constexpr double kEvident = 2.4;
  constexpr double kClipped = 0.2;  // of the light: what outshines the picture's range is no thing in it
  // An edge's height is its one drop, a line's intensity the mean of its two.
  double kept = 0, clipped = 0, others = bars + edges.length * std::min(0.5 * edges.height(), kEnoughLight),
         longest = 0;
  for (const FilteredLines& group : groups)
    for (const LineFacts& line : *group.facts) {
      const double light = light_of_line(line);
      (line.kept ? kept : others) += light;
      if (!line.kept) continue;
      clipped += line.clipped_share * light;
      longest = std::max(longest, even_widths(*group.kernels, line));
    }
  if (others == 0 || clipped >= kClipped * kept) return true;
  return longest >= least_widths && kept * kept >= kEvident * extent * others;
}

}  // namespace lightstripe
