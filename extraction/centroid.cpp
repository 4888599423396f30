// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/centroid.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "extraction/cross_profile.h"

namespace lightstripe {
namespace {

struct BrightRun {
  double centre = 0;  ///< px along the column (row)
  double half = 0;    ///< px
  double peak = 0;    ///< grey levels over T_l
};

/// Runs above `level` whose peak passes `start`, each with the centroid of grey value over `level`.
template <class T>
void bright_runs(const PixelLine<T>& line, double level, double start, int longest,
                 std::vector<BrightRun>& runs) {
  runs.clear();
  for (int i = 0; i < line.count; ++i) {
    if (line[i] <= level) continue;
    const int first = i;
    double weight = 0, moment = 0, peak = 0;
    for (; i < line.count && line[i] > level; ++i) {
      const double grey = line[i] - level;
      weight += grey;
      moment += grey * i;
      peak = std::max(peak, grey);
    }
    if (peak + level >= start && i - first >= 2 && i - first <= longest)
      runs.push_back({moment / weight, 0.5 * (i - first), peak});
  }
}

/// Mean length of the runs above `level`, px: short where stripes cross the columns (rows) steeply.
template <class T>
double mean_run(ImageView<T> image, bool columns, double level) {
  double runs = 0, pixels = 0;
  const int count = columns ? image.width : image.height;
  for (int k = 0; k < count; k += 4) {
    const PixelLine<T> line = columns ? column_line(image, k) : row_line(image, k);
    for (int i = 0; i < line.count; ++i) {
      if (line[i] <= level) continue;
      pixels += 1;
      if (i == 0 || line[i - 1] <= level) runs += 1;
    }
  }
  return runs == 0 ? 0 : pixels / runs;
}

struct OpenLine {
  std::vector<StripePoint> points;
  double centre = 0, half = 0;
  bool extended = true;
};

/// Normals from the neighbours along the line; strength as a Gaussian of that peak would have at scale sigma.
void finish(const OpenLine& line, const DerivativeKernels& kernels, LineSet& lines) {
  if (line.points.size() < 5) return;
  const auto count = static_cast<std::ptrdiff_t>(line.points.size());
  const std::size_t begin = lines.points.size();
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    StripePoint p = line.points[static_cast<std::size_t>(i)];
    const StripePoint& a = line.points[static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, i - 2))];
    const StripePoint& b = line.points[static_cast<std::size_t>(std::min(count - 1, i + 2))];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    p.normal_x = -(b.y - a.y) / length;
    p.normal_y = (b.x - a.x) / length;
    p.strength *= kernels.matched_strength();
    lines.points.push_back(p);
  }
  lines.lines.push_back({begin, lines.points.size()});
}

}  // namespace

template <class T>
void find_lines_centroid(ImageView<T> image, const DerivativeKernels& kernels, const RidgeLimits& limits,
                         LineSet& lines) {
  const double level = std::max(limits.level_low, 1.0);
  const bool columns = mean_run(image, true, level) <= mean_run(image, false, level);
  const double start = limits.hard_levels ? limits.level_high : level + limits.start_contrast;
  const int longest = 2 + static_cast<int>(8 * kernels.sigma);
  std::vector<BrightRun> runs;
  std::vector<OpenLine> open;
  const int count = columns ? image.width : image.height;
  for (int k = 0; k < count; ++k) {
    bright_runs(columns ? column_line(image, k) : row_line(image, k), level, start, longest, runs);
    for (OpenLine& line : open) line.extended = false;
    for (const BrightRun& run : runs) {
      OpenLine* best = nullptr;
      for (OpenLine& line : open)
        if (!line.extended && std::abs(line.centre - run.centre) < 0.5 * (line.half + run.half) + 1 &&
            (best == nullptr || std::abs(line.centre - run.centre) < std::abs(best->centre - run.centre)))
          best = &line;
      if (best == nullptr) {
        open.emplace_back();
        best = &open.back();
      }
      StripePoint p;
      p.x = columns ? k : run.centre;
      p.y = columns ? run.centre : k;
      p.strength = run.peak;
      best->points.push_back(p);
      best->centre = run.centre;
      best->half = run.half;
      best->extended = true;
    }
    for (OpenLine& line : open)
      if (!line.extended) finish(line, kernels, lines);
    std::erase_if(open, [](const OpenLine& line) { return !line.extended; });
  }
  for (const OpenLine& line : open) finish(line, kernels, lines);
}

template void find_lines_centroid<std::uint8_t>(ImageView8, const DerivativeKernels&, const RidgeLimits&,
                                                LineSet&);
template void find_lines_centroid<std::uint16_t>(ImageView16, const DerivativeKernels&, const RidgeLimits&,
                                                 LineSet&);

}  // namespace lightstripe
