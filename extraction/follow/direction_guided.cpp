// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/follow/direction_guided.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "extraction/follow/line_looks.h"
#include "extraction/image/binned_image.h"
#include "extraction/kernels/width_rule.h"

namespace lightstripe {
namespace {

/// Cells of the mask, about as large as the kernel's scale: fine enough for stripes of that scale, and no
/// smaller than an evaluation's stride.
int mask_cell_shift(double sigma) { return sigma < 2 ? 0 : sigma < 3 ? 1 : 2; }

/// First points come from the image itself, or from means of blocks where single pixels are too noisy.
template <class T>
void look_for_seeds(ImageView<T> image, double sigma, const RidgeLimits& limits, double brightest,
                    DirectionGuidedWorkspace<T>& w) {
  SeedRule rule;
  rule.level = limits.hard_levels ? limits.level_high : limits.level_low;
  rule.foreground = limits.level_high;
  rule.contrast = limits.start_contrast;
  rule.sigma = sigma;
  rule.brightest = brightest;
  if (limits.seed_block <= 1) {
    find_seeds(image, rule, w.seeds);
    return;
  }
  const int block = limits.seed_block;
  bin_image(image, block, w.binned);
  rule.sigma = sigma / block;
  find_seeds(w.binned.view(), rule, w.seeds);
  for (LineSeed& seed : w.seeds.sorted) {
    seed.x = seed.x * block + block / 2;
    seed.y = seed.y * block + block / 2;
  }
}

/// Follows the line through `start` to both ends and appends it, if it has a few points.
template <class T>
void follow_both_ways(const RidgeFinder<T>& finder, const RidgePlace& start, MaskLabels& labels,
                      DirectionGuidedWorkspace<T>& w, LineSet& lines) {
  constexpr std::size_t kLeastPoints = 5;
  const std::size_t checkpoint = w.mask.checkpoint();
  const LineRange before{lines.points.size(), lines.points.size()};
  labels.first = static_cast<std::uint16_t>(labels.current + 1);
  w.backward.clear();
  const bool closed = follow_one_way(finder, start, false, 0, w.mask, labels, w.backward);
  lines.points.insert(lines.points.end(), w.backward.rbegin(), w.backward.rend());
  lines.points.push_back(to_stripe_point(start));
  if (!closed) follow_one_way(finder, start, true, w.backward.size(), w.mask, labels, lines.points);
  const LineRange range{before.begin, lines.points.size()};
  if (range.size() >= kLeastPoints) {
    lines.lines.push_back(range);
  } else {
    lines.points.resize(before.begin);
    w.mask.relabel(checkpoint, labels.first, labels.current, ExclusionMask::kDead);
  }
}

/// Tries one place; false where no line begins.
template <class T>
bool try_seed(const RidgeFinder<T>& finder, int x, int y, MaskLabels& labels, DirectionGuidedWorkspace<T>& w,
              LineSet& lines) {
  if (w.mask(x, y) != ExclusionMask::kFree) return false;
  const auto start = finder.first_point(x, y);
  const auto sx = start ? static_cast<int>(std::lround(start->x)) : x;
  const auto sy = start ? static_cast<int>(std::lround(start->y)) : y;
  if (!start || !finder.image.contains(sx, sy) || w.mask(sx, sy) != ExclusionMask::kFree) {
    w.mask.mark_row(y, x, 1.0, ExclusionMask::kDead);
    return false;
  }
  const std::size_t before = lines.lines.size();
  follow_both_ways(finder, *start, labels, w, lines);
  return lines.lines.size() > before;
}

/// The free ridge nearest to the hint, on rings around it.
template <class T>
void follow_from_hint(const RidgeFinder<T>& finder, const FollowRule& rule, MaskLabels& labels,
                      DirectionGuidedWorkspace<T>& w, LineSet& lines) {
  const int reach = static_cast<int>(8 * finder.kernels.sigma);
  for (int r = 0; r <= reach; r += 2)
    for (int k = 0; k < std::max(1, 4 * r); ++k) {
      const double angle = 2 * std::numbers::pi * k / std::max(1, 4 * r);
      const auto x = static_cast<int>(std::lround(rule.start_x + r * std::cos(angle)));
      const auto y = static_cast<int>(std::lround(rule.start_y + r * std::sin(angle)));
      if (finder.image.contains(x, y) && try_seed(finder, x, y, labels, w, lines)) return;
    }
}

bool enough_lines(const FollowRule& rule, const LineSet& lines) {
  if (rule.stop_after == 0) return false;
  const auto count = std::count_if(lines.lines.begin(), lines.lines.end(), [&](const LineRange& r) {
    return static_cast<double>(r.size()) >= rule.least_length;
  });
  return count >= rule.stop_after;
}

/// Lines from the seeds, the brightest first, as long as there is hope.
template <class T>
struct SeedSearch {
  const RidgeFinder<T>& finder;
  const FollowRule& rule;
  MaskLabels& labels;
  DirectionGuidedWorkspace<T>& w;
  LineSet& lines;
  FollowTuning tuning;
  double strongest = 0;  ///< mean strength of the strongest line, short ones counting less

  void run();

 private:
  void try_seeds(bool beside_ends);
  void tell_patience(bool followed);
};

/// What the last line, or a place where none begins, says of the search.
template <class T>
void SeedSearch<T>::tell_patience(bool followed) {
  if (!followed) return w.patience.add_futile(tuning.futile_seed);
  const LineRange& r = lines.lines.back();
  const std::span<const StripePoint> points(lines.points.data() + r.begin, r.size());
  const double sigma = finder.kernels.sigma, length = static_cast<double>(r.size()),
               weight = length * mean_strength(points);
  if (length < rule.least_length || is_edge(finder.image, points, sigma))
    return w.patience.add_futile(tuning.futile_line + length / sigma);
  strongest = std::max(strongest, weight / std::max(length, 3 * rule.least_length));
  if (weight >= tuning.evident_line * rule.least_length * strongest)
    w.patience.add_line(points, full_width_of(sigma));
}

template <class T>
void SeedSearch<T>::try_seeds(bool beside_ends) {
  if (enough_lines(rule, lines)) return;
  for (const LineSeed& seed : w.seeds.sorted) {
    if (labels.current >= ExclusionMask::kLastLabel || w.patience.is_over()) return;
    if (w.mask(seed.x, seed.y) != ExclusionMask::kFree ||
        finder.image.laser_colour(seed.x, seed.y) == LaserPlace::kNone)
      continue;
    if (beside_ends && !w.patience.is_beside_end(seed.x, seed.y)) continue;
    const bool followed = try_seed(finder, seed.x, seed.y, labels, w, lines);
    tell_patience(followed);
    if (followed && enough_lines(rule, lines)) return;
  }
}

template <class T>
void SeedSearch<T>::run() {
  w.patience.reset(finder.image.width, finder.image.height, tuning);
  try_seeds(false);
  w.patience.try_beside_ends([this] { try_seeds(true); });
}

}  // namespace

template <class T>
bool follow_line_at(const RidgeFinder<T>& finder, int x, int y, MaskLabels& labels,
                    DirectionGuidedWorkspace<T>& workspace, LineSet& lines) {
  const auto start = finder.first_point(x, y);
  if (!start) return false;
  const auto sx = static_cast<int>(std::lround(start->x)), sy = static_cast<int>(std::lround(start->y));
  if (!finder.image.contains(sx, sy)) return false;
  const std::uint16_t label = workspace.mask(finder.in_mask(sx), finder.in_mask(sy));
  if (label != ExclusionMask::kFree && label != ExclusionMask::kDead) return false;
  const std::size_t before = lines.lines.size();
  follow_both_ways(finder, *start, labels, workspace, lines);
  return lines.lines.size() > before;
}

template <class T>
void follow_lines(ImageView<T> image, const DerivativeKernels& kernels, const RidgeLimits& limits,
                  const FollowRule& rule, DirectionGuidedWorkspace<T>& workspace, LineSet& lines) {
  if (image.empty() || rule.brightest <= 0) return;
  workspace.mask.reset(image.width, image.height, mask_cell_shift(kernels.sigma));
  const RidgeFinder<T> finder{image, kernels, limits, workspace.border_window};
  MaskLabels labels{0, 0};
  if (rule.has_start) follow_from_hint(finder, rule, labels, workspace, lines);
  if (enough_lines(rule, lines)) return;
  look_for_seeds(image, kernels.sigma, limits, rule.brightest, workspace);
  SeedSearch<T>{finder, rule, labels, workspace, lines, {}}.run();
}

template bool follow_line_at<std::uint8_t>(const RidgeFinder<std::uint8_t>&, int, int, MaskLabels&,
                                           DirectionGuidedWorkspace<std::uint8_t>&, LineSet&);
template bool follow_line_at<std::uint16_t>(const RidgeFinder<std::uint16_t>&, int, int, MaskLabels&,
                                            DirectionGuidedWorkspace<std::uint16_t>&, LineSet&);
template void follow_lines<std::uint8_t>(ImageView8, const DerivativeKernels&, const RidgeLimits&,
                                         const FollowRule&, DirectionGuidedWorkspace<std::uint8_t>&,
                                         LineSet&);
template void follow_lines<std::uint16_t>(ImageView16, const DerivativeKernels&, const RidgeLimits&,
                                          const FollowRule&, DirectionGuidedWorkspace<std::uint16_t>&,
                                          LineSet&);

}  // namespace lightstripe
