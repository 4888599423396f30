// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/direction_guided.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "extraction/direction_guided_step.h"
#include "extraction/kernels_scan.h"

namespace lightstripe {
namespace {

/// No line begins with fewer labels left than a long one uses.
constexpr std::uint16_t kLastLabel = 60000;

/// Rows that are searched for first points: thin stripes need each second one, a line of w >= 4 px each
/// fourth.
int seed_row_step(double sigma) { return std::clamp(static_cast<int>(sigma), 1, 4); }

/// Pixels that stand out over both neighbours at the stripe's full width: candidates for first points.
template <class T>
void collect_seeds(ImageView<T> image, double sigma, const RidgeLimits& limits, double brightest,
                   DirectionGuidedWorkspace<T>& w) {
  const double level = limits.hard_levels ? limits.level_high : limits.level_low;
  ScanRule<T> rule;
  rule.level = static_cast<T>(std::clamp(std::ceil(level), 0.0, brightest));
  rule.contrast = static_cast<T>(std::max(1.0, std::ceil(limits.start_contrast)));
  rule.reach = std::max(2, static_cast<int>(std::lround(3.2 * sigma)));
  w.seeds.clear();
  w.zeros.assign(static_cast<std::size_t>(image.width), T{});
  w.candidate_masks.resize(static_cast<std::size_t>((image.width + 63) / 64));
  const int step = seed_row_step(sigma);
  // Of a wide stripe every second pixel of the row is enough, too.
  const std::uint64_t columns = step >= 2 ? 0x5555555555555555ULL : ~0ULL;
  for (int y = step / 2; y < image.height; y += step) {
    const ScanRow<T> row{image.row(y), y >= rule.reach ? image.row(y - rule.reach) : w.zeros.data(),
                         y + rule.reach < image.height ? image.row(y + rule.reach) : w.zeros.data()};
    const auto add = [&](int x) {
      const double contrast = candidate_contrast(row, x, image.width, rule.reach);
      if (contrast < rule.contrast || row.centre[x] < rule.level) return;
      w.seeds.push_back({x, y, static_cast<std::int32_t>(contrast * (255.0 / brightest)),
                         row.centre[x] >= limits.level_high});
    };
    for (int x = 0; x < std::min(rule.reach, image.width); ++x) add(x);
    if (mark_candidates(row, image.width, rule, w.candidate_masks.data()))
      for (std::size_t word = 0; word < w.candidate_masks.size(); ++word)
        for (std::uint64_t bits = w.candidate_masks[word] & columns; bits != 0; bits &= bits - 1)
          add(static_cast<int>(word * 64) + std::countr_zero(bits));
    for (int x = std::max(image.width - rule.reach, rule.reach); x < image.width; ++x) add(x);
  }
}

/// Foreground before undecided pixels, then by falling contrast, then in reading order (a counting sort).
template <class T>
void sort_seeds(DirectionGuidedWorkspace<T>& w) {
  constexpr std::int32_t kRanks = 512;
  const auto rank = [](const LineSeed& s) {
    return static_cast<std::size_t>(kRanks - 1 - ((s.foreground ? 256 : 0) + std::min(s.rank, 255)));
  };
  std::array<std::size_t, kRanks + 1> first{};
  for (const LineSeed& s : w.seeds) ++first[rank(s) + 1];
  for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
  w.sorted_seeds.resize(w.seeds.size());
  for (const LineSeed& s : w.seeds) w.sorted_seeds[first[rank(s)]++] = s;
}

/// Follows the line through `start` to both ends and appends it, if it has a few points.
template <class T>
void follow_both_ways(const RidgeFinder<T>& finder, const RidgePlace& start, LineLabels& labels,
                      DirectionGuidedWorkspace<T>& w, LineSet& lines) {
  constexpr std::size_t kLeastPoints = 5;
  const std::size_t checkpoint = w.mask.checkpoint();
  const LineRange before{lines.points.size(), lines.points.size()};
  labels.first = static_cast<std::uint16_t>(labels.current + 1);
  w.backward.clear();
  const bool closed = follow_one_way(finder, start, false, w.mask, labels, w.backward);
  lines.points.insert(lines.points.end(), w.backward.rbegin(), w.backward.rend());
  lines.points.push_back(to_stripe_point(start));
  if (!closed) follow_one_way(finder, start, true, w.mask, labels, lines.points);
  const LineRange range{before.begin, lines.points.size()};
  if (range.size() >= kLeastPoints) {
    lines.lines.push_back(range);
  } else {
    lines.points.resize(before.begin);
    w.mask.relabel(checkpoint, labels.first, labels.current, ExclusionMask::kDead);
  }
}

}  // namespace

template <class T>
void follow_lines(ImageView<T> image, const DerivativeKernels& kernels, const RidgeLimits& limits,
                  double brightest, DirectionGuidedWorkspace<T>& workspace, LineSet& lines) {
  if (image.empty() || brightest <= 0) return;
  workspace.mask.reset(image.width, image.height);
  collect_seeds(image, kernels.sigma, limits, brightest, workspace);
  sort_seeds(workspace);
  const RidgeFinder<T> finder{image, kernels, limits, workspace.border_window};
  LineLabels labels{0, 0};
  for (const LineSeed& seed : workspace.sorted_seeds) {
    if (workspace.mask(seed.x, seed.y) != ExclusionMask::kFree) continue;
    const auto start = finder.first_point(seed.x, seed.y);
    const auto sx = start ? static_cast<int>(std::lround(start->x)) : seed.x;
    const auto sy = start ? static_cast<int>(std::lround(start->y)) : seed.y;
    if (!start || !image.contains(sx, sy) || workspace.mask(sx, sy) != ExclusionMask::kFree) {
      workspace.mask.mark_row(seed.y, seed.x, 1.0, ExclusionMask::kDead);
      continue;
    }
    if (labels.current >= kLastLabel) break;
    follow_both_ways(finder, *start, labels, workspace, lines);
  }
}

template void follow_lines<std::uint8_t>(ImageView8, const DerivativeKernels&, const RidgeLimits&, double,
                                         DirectionGuidedWorkspace<std::uint8_t>&, LineSet&);
template void follow_lines<std::uint16_t>(ImageView16, const DerivativeKernels&, const RidgeLimits&, double,
                                          DirectionGuidedWorkspace<std::uint16_t>&, LineSet&);

}  // namespace lightstripe
