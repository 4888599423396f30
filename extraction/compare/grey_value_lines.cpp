// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/compare/grey_value_lines.h"

#include <algorithm>
#include <cmath>

#include "extraction/lines/cross_profile.h"

namespace lightstripe {
namespace {

/// First and second derivative of the line smoothed by the kernel, at a place; border pixels are repeated.
template <class T>
struct LineSlopes {
  double first = 0, second = 0;
  LineSlopes(const PixelLine<T>& line, const DerivativeKernels& kernels, PhasedPosition at) {
    const float* weights = kernels.phase(at.phase);
    for (int i = 0; i < kernels.taps; ++i) {
      const double grey = line[std::clamp(at.pixel - kernels.radius + i, 0, line.count - 1)];
      first += grey * double{weights[kernels.pitch + i]};
      second += grey * double{weights[2 * kernels.pitch + i]};
    }
  }
};

/// The smoothed line's peak near `start`: Newton steps, repeated so that no phase bias remains. The start
/// where there is none.
template <class T>
double peak_place(const PixelLine<T>& line, const DerivativeKernels& kernels, double start, double reach) {
  double place = start;
  for (int step = 0; step < 5; ++step) {
    const PhasedPosition at = to_phase(place);
    const LineSlopes<T> slopes(line, kernels, at);
    if (slopes.second >= 0) return start;
    const double move = std::clamp(-slopes.first / slopes.second, -1.0, 1.0);
    place = at.value() + move;
    if (std::abs(place - start) > reach) return start;
    if (std::abs(move) < 0.1) break;
  }
  return place;
}

struct RunRule {
  double level = 0;  ///< grey levels: pixels of a run are brighter
  double start = 0;  ///< grey levels: its brightest pixel
  int longest = 0;   ///< px
};

template <class T>
void bright_runs(const PixelLine<T>& line, const RunRule& rule, const DerivativeKernels& kernels,
                 GreyValueCentre centre, std::vector<BrightRun>& runs) {
  runs.clear();
  for (int i = 0; i < line.count; ++i) {
    if (line[i] <= rule.level) continue;
    const int first = i;
    double weight = 0, moment = 0, peak = 0;
    for (; i < line.count && line[i] > rule.level; ++i) {
      const double grey = line[i] - rule.level;
      weight += grey;
      moment += grey * i;
      peak = std::max(peak, grey);
    }
    if (peak + rule.level < rule.start || i - first < 2 || i - first > rule.longest) continue;
    BrightRun run{moment / weight, 0.5 * (i - first), peak};
    if (centre == GreyValueCentre::kExtremum) run.centre = peak_place(line, kernels, run.centre, run.half);
    runs.push_back(run);
  }
}

/// Gives each run to the open line that it touches, or opens a new one; returns how many lines there are.
int join_runs(int position, bool columns, int count, GreyValueWorkspace& w) {
  for (auto& line : w.open) line.extended = false;
  for (const BrightRun& run : w.runs) {
    GreyValueWorkspace::OpenLine* best = nullptr;
    for (auto& line : w.open)
      if (!line.extended && std::abs(line.centre - run.centre) < 0.5 * (line.half + run.half) + 1 &&
          (best == nullptr || std::abs(line.centre - run.centre) < std::abs(best->centre - run.centre)))
        best = &line;
    if (best == nullptr) {
      w.open.push_back({count++, 0, 0, true});
      best = &w.open.back();
    }
    StripePoint p;
    p.x = columns ? position : run.centre;
    p.y = columns ? run.centre : position;
    p.strength = run.peak;
    w.points.push_back(p);
    w.numbers.push_back(best->number);
    *best = {best->number, run.centre, run.half, true};
  }
  std::erase_if(w.open, [](const auto& line) { return !line.extended; });
  return count;
}

/// The points line by line; normals from the neighbours along the line; strength as a Gaussian of that peak
/// would have at scale sigma.
void hand_over(int count, const DerivativeKernels& kernels, GreyValueWorkspace& w, LineSet& lines) {
  constexpr std::size_t kLeastPoints = 5;
  w.offsets.assign(static_cast<std::size_t>(count) + 1, 0);
  for (const int number : w.numbers) ++w.offsets[static_cast<std::size_t>(number) + 1];
  for (std::size_t k = 1; k < w.offsets.size(); ++k) w.offsets[k] += w.offsets[k - 1];
  lines.points.resize(w.points.size());
  for (std::size_t k = 0; k + 1 < w.offsets.size(); ++k)
    if (w.offsets[k + 1] - w.offsets[k] >= kLeastPoints)
      lines.lines.push_back({w.offsets[k], w.offsets[k + 1]});
  for (std::size_t i = 0; i < w.points.size(); ++i)
    lines.points[w.offsets[static_cast<std::size_t>(w.numbers[i])]++] = w.points[i];
  for (const LineRange& r : lines.lines)
    for (std::size_t i = r.begin; i < r.end; ++i) {
      const StripePoint &a = lines.points[std::max(r.begin + 2, i) - 2],
                        &b = lines.points[std::min(r.end - 1, i + 2)];
      const double length = std::hypot(b.x - a.x, b.y - a.y);
      lines.points[i].normal_x = -(b.y - a.y) / length;
      lines.points[i].normal_y = (b.x - a.x) / length;
      lines.points[i].strength *= kernels.matched_strength();
    }
}

/// Whether the line, seen over a few points to both sides of `i`, runs along the rows (so that its columns
/// cross it) rather than along the columns.
bool runs_along_rows(const LineSet& lines, const LineRange& r, std::size_t i, std::size_t reach) {
  const StripePoint &a = lines.points[std::max(r.begin + reach, i) - reach],
                    &b = lines.points[std::min(r.end - 1, i + reach)];
  // At 45 degrees the columns have it, by more than noise turns the line.
  constexpr double kInFavour = 1.05;
  return kInFavour * std::abs(b.x - a.x) >= std::abs(b.y - a.y);
}

/// Appends the parts of `found` that the axis it was found along crosses at less than 45 degrees; a line that
/// is nearly all of that kind stays whole.
void keep_well_crossed(const LineSet& found, bool columns, std::size_t reach, std::vector<char>& well,
                       LineSet& lines) {
  constexpr double kNearlyAll = 0.95;
  constexpr std::size_t kLeastPoints = 5;
  for (const LineRange& r : found.lines) {
    well.clear();
    std::size_t count = 0;
    for (std::size_t i = r.begin; i < r.end; ++i) {
      well.push_back(runs_along_rows(found, r, i, reach) == columns ? 1 : 0);
      count += well.back() != 0 ? 1U : 0U;
    }
    const double share = static_cast<double>(count) / static_cast<double>(r.size());
    if (share > kNearlyAll || share < 1 - kNearlyAll)
      std::fill(well.begin(), well.end(), share > 0.5 ? 1 : 0);
    for (std::size_t begin = 0; begin < well.size(); ++begin) {
      if (well[begin] == 0) continue;
      std::size_t end = begin;
      while (end < well.size() && well[end] != 0) ++end;
      if (end - begin >= kLeastPoints) {
        const auto first = found.points.begin() + static_cast<std::ptrdiff_t>(r.begin);
        const std::size_t at = lines.points.size();
        lines.points.insert(lines.points.end(), first + static_cast<std::ptrdiff_t>(begin),
                            first + static_cast<std::ptrdiff_t>(end));
        lines.lines.push_back({at, lines.points.size()});
      }
      begin = end;
    }
  }
}

}  // namespace

template <class T>
void find_lines_by_grey_value(ImageView<T> image, const DerivativeKernels& kernels, const RidgeLimits& limits,
                              GreyValueCentre centre, GreyValueWorkspace& w, LineSet& lines) {
  RunRule rule;
  rule.level = std::max(limits.level_low, 1.0);
  rule.start = limits.hard_levels ? limits.level_high : rule.level + limits.start_contrast;
  rule.longest = 2 + static_cast<int>(8 * kernels.sigma);
  // A line at 45 degrees is cut to pieces unless its direction is seen over more than its noise.
  const auto reach = static_cast<std::size_t>(8 + 4 * kernels.sigma);
  for (const bool columns : {true, false}) {
    w.open.clear();
    w.points.clear();
    w.numbers.clear();
    w.found.clear();
    int count = 0;
    for (int k = 0; k < (columns ? image.width : image.height); ++k) {
      bright_runs(columns ? column_line(image, k) : row_line(image, k), rule, kernels, centre, w.runs);
      count = join_runs(k, columns, count, w);
    }
    hand_over(count, kernels, w, w.found);
    keep_well_crossed(w.found, columns, reach, w.well_crossed, lines);
  }
}

template void find_lines_by_grey_value<std::uint8_t>(ImageView8, const DerivativeKernels&, const RidgeLimits&,
                                                     GreyValueCentre, GreyValueWorkspace&, LineSet&);
template void find_lines_by_grey_value<std::uint16_t>(ImageView16, const DerivativeKernels&,
                                                      const RidgeLimits&, GreyValueCentre,
                                                      GreyValueWorkspace&, LineSet&);

}  // namespace lightstripe
