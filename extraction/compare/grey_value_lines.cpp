// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/compare/grey_value_lines.h"

#include <algorithm>
#include <cmath>

#include "extraction/lines/cross_profile.h"

namespace lightstripe {
namespace {

constexpr int kNoLine = -1;

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
  double level = 0;     ///< grey levels: pixels of a run are brighter
  double contrast = 0;  ///< grey levels: a run's brightest pixel over the run's level
  int longest = 0;      ///< px
};

/// The pixels of a column or row, and of what crosses it.
template <class T>
struct Cut {
  ImageView<T> image;
  bool column = false;
  int position = 0;
  PixelLine<T> line() const { return column ? column_line(image, position) : row_line(image, position); }
  PixelLine<T> across(int i) const { return column ? row_line(image, i) : column_line(image, i); }
};

/// Whether at least `length` pixels in a row are brighter than `level`, the pixel at `place` among them.
template <class T>
bool is_bright_along(const PixelLine<T>& line, int place, double level, int length) {
  int first = place, end = place;
  while (end < line.count && end - place < length && line[end] > level) ++end;
  while (first > 0 && end - first < length && line[first - 1] > level) --first;
  return end - first >= length;
}

/// The runs over `level` among the cut's pixels [begin, end). In one that is too long, a glow or a lit floor,
/// the stripe is what stands out over half of its height. It is at most half as long, or two stripes touch
/// there; and it does not run along the cut.
template <class T>
void runs_over(const Cut<T>& cut, int begin, int end, double level, const RunRule& rule,
               std::vector<BrightRun>& runs) {
  const PixelLine<T> line = cut.line();
  for (int i = begin; i < end; ++i) {
    if (line[i] <= level) continue;
    const int first = i;
    int brightest = i;
    double weight = 0, moment = 0;
    for (; i < end && line[i] > level; ++i) {
      const double grey = line[i] - level;
      weight += grey;
      moment += grey * i;
      if (line[i] > line[brightest]) brightest = i;
    }
    const double peak = line[brightest] - level;
    const int length = i - first;
    if (peak < rule.contrast || length < 2) continue;
    if (length > rule.longest) {
      RunRule over = rule;
      over.longest = std::min(rule.longest, length / 2);
      runs_over(cut, first, i, level + 0.5 * peak, over, runs);
    } else if (level == rule.level ||
               is_bright_along(cut.across(brightest), cut.position, level, length / 2)) {
      runs.push_back({moment / weight, 0.5 * length, peak});
    }
  }
}

/// The bright runs of a column or row.
template <class T>
void bright_runs(const Cut<T>& cut, const RunRule& rule, const DerivativeKernels& kernels,
                 GreyValueCentre centre, std::vector<BrightRun>& runs) {
  runs.clear();
  const PixelLine<T> line = cut.line();
  runs_over(cut, 0, line.count, rule.level, rule, runs);
  if (centre == GreyValueCentre::kExtremum)
    for (BrightRun& run : runs) run.centre = peak_place(line, kernels, run.centre, run.half);
}

bool touches(const GreyValueWorkspace::OpenLine& line, const BrightRun& run) {
  return std::abs(line.centre - run.centre) < 0.5 * (line.half + run.half) + 1;
}

/// Where two lines become one run, or one run becomes two, that run's centre lies between two stripes: its
/// point goes.
void drop_forks(GreyValueWorkspace& w) {
  for (const auto& line : w.open) {
    const auto touching =
        std::count_if(w.runs.begin(), w.runs.end(), [&](const BrightRun& run) { return touches(line, run); });
    if (touching > 1) w.numbers[line.point] = kNoLine;
  }
  std::erase_if(w.runs, [&](const BrightRun& run) {
    return std::count_if(w.open.begin(), w.open.end(), [&](const auto& line) { return touches(line, run); }) >
           1;
  });
}

/// Gives each run to the open line that it touches, or opens a new one; returns how many lines there are.
int join_runs(int position, bool columns, int count, GreyValueWorkspace& w) {
  for (auto& line : w.open) line.extended = false;
  for (const BrightRun& run : w.runs) {
    GreyValueWorkspace::OpenLine* best = nullptr;
    for (auto& line : w.open)
      if (!line.extended && touches(line, run) &&
          (best == nullptr || std::abs(line.centre - run.centre) < std::abs(best->centre - run.centre)))
        best = &line;
    if (best == nullptr) {
      w.open.push_back({count++, 0, 0, 0, true});
      best = &w.open.back();
    }
    *best = {best->number, w.points.size(), run.centre, run.half, true};
    StripePoint p;
    p.x = columns ? position : run.centre;
    p.y = columns ? run.centre : position;
    p.strength = run.peak;
    w.points.push_back(p);
    w.numbers.push_back(best->number);
  }
  std::erase_if(w.open, [](const auto& line) { return !line.extended; });
  return count;
}

/// The points line by line; normals from the neighbours along the line; strength as a Gaussian of that peak
/// would have at scale sigma.
void hand_over(int count, const DerivativeKernels& kernels, GreyValueWorkspace& w, LineSet& lines) {
  constexpr std::size_t kLeastPoints = 5;
  std::replace(w.numbers.begin(), w.numbers.end(), kNoLine, count);
  w.offsets.assign(static_cast<std::size_t>(count) + 2, 0);
  for (const int number : w.numbers) ++w.offsets[static_cast<std::size_t>(number) + 1];
  for (std::size_t k = 1; k < w.offsets.size(); ++k) w.offsets[k] += w.offsets[k - 1];
  lines.points.resize(w.points.size());
  for (std::size_t k = 0; k + 2 < w.offsets.size(); ++k)
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

/// The point of the line that lies `reach` px from point `i`, towards its beginning (`step` -1) or end (1);
/// its last one where it is shorter.
const StripePoint& point_at(const LineSet& lines, const LineRange& r, std::size_t i, int step, double reach) {
  const StripePoint& from = lines.points[i];
  const std::size_t last = step < 0 ? r.begin : r.end - 1;
  while (i != last && std::hypot(lines.points[i].x - from.x, lines.points[i].y - from.y) < reach)
    i += static_cast<std::size_t>(step);
  return lines.points[i];
}

/// Whether the line, seen over `reach` px to both sides of `i`, runs along the rows (so that its columns
/// cross it) rather than along the columns. Found by columns or by rows, it is seen over the same part of
/// itself: where it bends, one answer holds for both.
bool runs_along_rows(const LineSet& lines, const LineRange& r, std::size_t i, double reach) {
  const StripePoint &a = point_at(lines, r, i, -1, reach), &b = point_at(lines, r, i, 1, reach);
  // At 45 degrees the columns have it, by more than noise turns the line.
  constexpr double kInFavour = 1.05;
  return kInFavour * std::abs(b.x - a.x) >= std::abs(b.y - a.y);
}

/// Appends the parts of `found` that the axis it was found along crosses at less than 45 degrees; a line that
/// is nearly all of that kind stays whole.
void keep_well_crossed(const LineSet& found, bool columns, double reach, std::vector<char>& well,
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
  rule.contrast = limits.hard_levels ? limits.level_high - rule.level : limits.start_contrast;
  rule.longest = 2 + static_cast<int>(8 * kernels.sigma);
  // A line at 45 degrees is cut to pieces unless its direction is seen over more than its noise.
  const double reach = 12 + 6 * kernels.sigma;
  for (const bool columns : {true, false}) {
    w.open.clear();
    w.points.clear();
    w.numbers.clear();
    w.found.clear();
    int count = 0;
    for (int k = 0; k < (columns ? image.width : image.height); ++k) {
      bright_runs(Cut<T>{image, columns, k}, rule, kernels, centre, w.runs);
      drop_forks(w);
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
