// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/follow/own_scale.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "extraction/follow/direction_guided_between.h"
#include "extraction/kernels/width_rule.h"
#include "extraction/lines/line_measure.h"

namespace lightstripe {
namespace {

/// Rungs of the ladder that a seed of one level may belong to: those of its own
/// level and the next ones.
struct RungRange {
  int first, last;
};
RungRange rungs_of(int level) { return {2 * level - 2, 2 * level + 4}; }

template <class T>
class LineFinder {
 public:
  LineFinder(const OwnScaleSearch<T>& search, const LimitsMaker& limits, KernelCache& kernels,
             DirectionGuidedWorkspace<T>& following, OwnScaleWorkspace<T>& w, ScaleGroups& groups)
      : search_(search), limits_(limits), kernels_(kernels), following_(following), w_(w), groups_(groups) {}

  void run();

 private:
  /// A line just followed, as long as it may still be taken back.
  struct Followed {
    std::size_t group = 0;
    LineRange range;
    std::size_t checkpoint = 0;
    std::uint16_t first_label = 0;
  };

  void prepare();
  void begin();
  std::uint8_t& tried(int level, int x, int y);
  std::size_t group_for(double sigma, double tolerance);
  std::optional<Followed> follow(std::size_t group, int x, int y);
  void to_full_image(ScaleGroup& group);
  void take_back(const Followed& line);
  void block(const Followed& line, double sigmas, int finest_level);
  std::uint8_t& blocked(int x, int y) {
    const auto columns = static_cast<std::size_t>(search_.image.width / 4 + 1);
    return w_.blocked[static_cast<std::size_t>(y / 4) * columns + static_cast<std::size_t>(x / 4)];
  }
  std::optional<Followed> at_own_scale(const Followed& line, int x, int y, double least_broader);
  double grain_of(const Followed& line, double width_scale);
  void allow_for_grain(std::size_t group, double weight, double grain, double broader);
  bool is_clipped(std::span<const StripePoint> points) const;
  double length(const Followed& line) const { return static_cast<double>(line.range.size()); }
  std::span<const StripePoint> points_of(const Followed& line) const {
    return {groups_.all[line.group].lines.points.data() + line.range.begin, line.range.size()};
  }
  void add_futile(const Followed& line) {
    w_.patience.add_futile(search_.tuning.futile_line +
                           length(line) / groups_.all[line.group].kernels->sigma);
  }
  double height(const Followed& line) const;
  double weight(const Followed& line) const { return length(line) * height(line); }
  bool runs_beside_another(const Followed& line) const;
  bool is_edge(const Followed& line) const;
  void note_grain(const Followed& line);
  void keep_or_reject(const Followed& line, int seed_level);
  bool is_untried(const ScaleSeed& seed);
  void try_seed(const ScaleSeed& seed);
  void try_seeds(bool beside_ends);
  bool has_enough() const { return search_.stop_after > 0 && lines_ >= search_.stop_after; }

  const OwnScaleSearch<T>& search_;
  const LimitsMaker& limits_;
  KernelCache& kernels_;
  DirectionGuidedWorkspace<T>& following_;
  OwnScaleWorkspace<T>& w_;
  ScaleGroups& groups_;
  MaskLabels labels_;
  double strongest_ = 0;  ///< grey levels, height of the strongest line so far
  int lines_ = 0;
  double heaviest_ = 0;  ///< px times grey levels: the largest length times height of a line so far
  double grained_sigma_ = 0, grain_ = 0;  ///< of the kernels of a grained line; 0: none yet
};

template <class T>
void LineFinder<T>::prepare() {
  if (search_.windowed != nullptr)
    build_pyramid(search_.image, search_.windowed->noise, *search_.windowed->seen, w_.pyramid);
  else
    build_pyramid(search_.image, search_.noise, w_.pyramid);
  w_.found.clear();
  const SearchWindows* windows = search_.windowed != nullptr ? search_.windowed->seeds : nullptr;
  for (int level = 0; level < w_.pyramid.count; ++level) {
    if (search_.windowed == nullptr || level <= search_.windowed->coarsest)
      collect_scale_seeds(w_.pyramid, level, {search_.brightest, windows}, following_.seeds, w_.found);
  }
  sort_by_contrast(w_.found, w_.seeds);
}

/// Nothing is tried yet.
template <class T>
void LineFinder<T>::begin() {
  for (int level = 0; level < w_.pyramid.count; ++level) {
    const ImageView<T> image = w_.pyramid.levels[static_cast<std::size_t>(level)];
    w_.tried[static_cast<std::size_t>(level)].assign(
        static_cast<std::size_t>(image.width / 4 + 1) * static_cast<std::size_t>(image.height / 4 + 1), 0);
  }
  w_.blocked.assign(static_cast<std::size_t>(search_.image.width / 4 + 1) *
                        static_cast<std::size_t>(search_.image.height / 4 + 1),
                    0);
  following_.mask.reset(search_.image.width, search_.image.height, 1);
  w_.patience.reset(search_.image.width, search_.image.height, search_.tuning);
  groups_.count = 0;
  labels_ = {};
  strongest_ = heaviest_ = 0;
  lines_ = 0;
}

/// The cell of 4 x 4 pixels of a level.
template <class T>
std::uint8_t& LineFinder<T>::tried(int level, int x, int y) {
  const auto k = static_cast<std::size_t>(level);
  const ImageView<T> image = w_.pyramid.levels[k];
  const int column = std::clamp(x >> (level + 2), 0, image.width / 4),
            row = std::clamp(y >> (level + 2), 0, image.height / 4);
  return w_.tried[k][static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width / 4 + 1) +
                     static_cast<std::size_t>(column)];
}

/// The group with the nearest scale, or a new one.
template <class T>
std::size_t LineFinder<T>::group_for(double sigma, double tolerance) {
  std::size_t best = groups_.count;
  for (std::size_t g = 0; g < groups_.count; ++g) {
    const double distance = std::abs(std::log2(sigma / groups_.all[g].kernels->sigma));
    if (distance > tolerance) continue;
    tolerance = distance;
    best = g;
  }
  if (best < groups_.count) return best;
  const DerivativeKernels& kernels = kernels_.nearest(sigma);
  ScaleGroup& group = groups_.add(kernels);
  while (group.level + 1 < w_.pyramid.count && sigma >= search_.tuning.binned_sigma * (2 << group.level))
    ++group.level;
  group.binned_kernels = &kernels_.nearest(kernels.sigma / (1 << group.level));
  group.limits = limits_(*group.binned_kernels, w_.pyramid.noise[static_cast<std::size_t>(group.level)]);
  return best;
}

template <class T>
std::optional<typename LineFinder<T>::Followed> LineFinder<T>::follow(std::size_t group, int x, int y) {
  ScaleGroup& g = groups_.all[group];
  const RidgeFinder<T> finder{w_.pyramid.levels[static_cast<std::size_t>(g.level)], *g.binned_kernels,
                              g.limits, following_.border_window, g.level};
  Followed line{group, {}, following_.mask.checkpoint(), static_cast<std::uint16_t>(labels_.current + 1)};
  if (!follow_line_at(finder, x >> g.level, y >> g.level, labels_, following_, g.lines)) return std::nullopt;
  if (g.level > 0) to_full_image(g);
  line.range = g.lines.lines.back();
  return line;
}

/// The last line of a group, from its level's pixels to the image's own.
template <class T>
void LineFinder<T>::to_full_image(ScaleGroup& group) {
  LineRange& range = group.lines.lines.back();
  std::vector<StripePoint>& points = group.lines.points;
  w_.binned_points.assign(points.begin() + static_cast<std::ptrdiff_t>(range.begin), points.end());
  points.resize(range.begin);
  append_in_full_image(w_.binned_points, group.level, points);
  range.end = points.size();
}

/// The line goes, and its place is free again.
template <class T>
void LineFinder<T>::take_back(const Followed& line) {
  LineSet& lines = groups_.all[line.group].lines;
  lines.lines.pop_back();
  lines.points.resize(line.range.begin);
  following_.mask.relabel(line.checkpoint, line.first_label, labels_.current, ExclusionMask::kFree);
}

/// A good part of the points lies on the picture's brightest pixels.
template <class T>
bool LineFinder<T>::is_clipped(std::span<const StripePoint> points) const {
  std::size_t clipped = 0;
  for (const StripePoint& p : points) {
    const int x = std::clamp(static_cast<int>(p.x + 0.5), 0, search_.image.width - 1),
              y = std::clamp(static_cast<int>(p.y + 0.5), 0, search_.image.height - 1);
    clipped += search_.image(x, y) >= search_.tuning.clipped_level * search_.brightest ? 1U : 0U;
  }
  return 4 * clipped > points.size();
}

/// How much a line's strength varies by the grain of its light, as a share of it. `width_scale`: the scale
/// that the stripe's width asks for.
template <class T>
double LineFinder<T>::grain_of(const Followed& line, double width_scale) {
  const ScaleGroup& g = groups_.all[line.group];
  const std::span<const StripePoint> points(g.lines.points.data() + line.range.begin, line.range.size());
  const double bin = 1 << g.level, noise = w_.pyramid.noise[static_cast<std::size_t>(g.level)] *
                                           g.binned_kernels->curvature_gain / (bin * bin);
  // The strength of a clipped bar varies with its outline, that of a thin line with its place between pixels.
  if (width_scale < search_.tuning.thinnest_grained || is_clipped(points)) return 0;
  return grain_of_line(points, g.kernels->sigma, noise, w_.values);
}

/// A kernel of the stripe's own width is best in the camera's noise, which it takes in from beside the
/// stripe; the grain of speckle is in the stripe's own light, and the more of it a kernel averages the
/// better. Returns times the scale that the width asks for.
double broader_in_grain(double grain, const FollowTuning& t) {
  return std::clamp(1 + (grain - t.fine_grain) / (t.coarse_grain - t.fine_grain), 1.0, 2.0);
}

/// Where the picture's main line is coarsely grained, so much is allowed to its kernels: the grain varies the
/// curvature along a line as much as that across it.
template <class T>
void LineFinder<T>::allow_for_grain(std::size_t group, double weight, double grain, double broader) {
  const FollowTuning& t = search_.tuning;
  if (grain < t.main_grain || weight < t.main_line * heaviest_) return;
  RidgeLimits& limits = groups_.all[group].limits;
  limits.grain = std::max(limits.grain, grain / std::pow(broader, t.grain_falls));
}

/// The line followed again at its own scale, where that differs and does not
/// lose much of it.
template <class T>
std::optional<typename LineFinder<T>::Followed> LineFinder<T>::at_own_scale(const Followed& line, int x,
                                                                            int y, double least_broader) {
  const LineSet& lines = groups_.all[line.group].lines;
  const std::span<const StripePoint> points(lines.points.data() + line.range.begin, line.range.size());
  const double used = groups_.all[line.group].kernels->sigma;
  const double farthest = std::exp2(search_.tuning.farthest_scale);
  const double width_scale = scale_of_line(w_.pyramid, kernels_, points, used);
  const double seen = grain_of(line, width_scale);
  const double grain =
      seen * std::pow(used / width_scale, search_.tuning.grain_falls);  // at the width's scale
  const double broader = broader_in_grain(grained_sigma_ > 0 ? grain : seen, search_.tuning);
  if (broader < least_broader) return line;
  const double own = std::clamp(broader * width_scale, used / farthest, used * farthest);
  const bool first_of_its_scale = lines.lines.size() == 1;
  const double tolerance = first_of_its_scale ? search_.tuning.first_scale : search_.tuning.refollow_scale;
  if (std::abs(std::log2(own / used)) <= tolerance) {
    allow_for_grain(line.group, weight(line), grain, broader);
    return line;
  }
  // Where a dark grain hides the line from the broader kernels, another place shows it.
  const std::array<StripePoint, 3> places{points[points.size() / 2], points[points.size() / 4],
                                          points[3 * points.size() / 4]};
  const bool much_finer = std::log2(used / own) > search_.tuning.much_finer_scale;
  const double least =
      (much_finer ? search_.tuning.kept_length_of_finer : search_.tuning.kept_length) * length(line);
  const double weight_before = weight(line);
  take_back(line);
  const std::size_t group = group_for(own, 0.5 * tolerance);
  allow_for_grain(group, weight_before, grain, broader);
  for (const StripePoint& p : places) {
    const auto again = follow(group, nearest_pixel(p.x), nearest_pixel(p.y));
    if (again && length(*again) >= least) return again;
    if (again) take_back(*again);
    if (again || broader <= 1 || length(line) < search_.tuning.worth_other_places * own) break;
  }
  return follow(line.group, x, y);
}

template <class T>
double LineFinder<T>::height(const Followed& line) const {
  const ScaleGroup& g = groups_.all[line.group];
  double sum = 0;
  for (std::size_t i = line.range.begin; i < line.range.end; ++i) sum += g.lines.points[i].strength;
  return sum / length(line) / g.kernels->matched_strength();
}

/// The light falls on one side only. The filter drops such a line later, by its
/// own profiles; here it tells how much of the search is in vain.
template <class T>
bool LineFinder<T>::is_edge(const Followed& line) const {
  constexpr double kAside = 2.6,
                   kLeastFlanks = 0.3;  // sigma; of the smaller over the larger drop
  const ScaleGroup& g = groups_.all[line.group];
  const double reach = kAside * g.kernels->sigma;
  const std::size_t step = std::max<std::size_t>(1, line.range.size() / 24);
  std::size_t looked_at = 0, one_sided = 0;
  const auto grey = [&](const StripePoint& p, double aside) {
    const int x = std::clamp(nearest_pixel(p.x + aside * p.normal_x), 0, search_.image.width - 1),
              y = std::clamp(nearest_pixel(p.y + aside * p.normal_y), 0, search_.image.height - 1);
    return static_cast<double>(search_.image(x, y));
  };
  for (std::size_t i = line.range.begin; i < line.range.end; i += step) {
    const StripePoint& p = g.lines.points[i];
    const double top = grey(p, 0), left = top - grey(p, -reach), right = top - grey(p, reach);
    ++looked_at;
    one_sided += std::min(left, right) < kLeastFlanks * std::max(left, right) ? 1U : 0U;
  }
  return 2 * one_sided > looked_at;
}

/// In the glow of a line that is already found broad kernels see it once more:
/// most of what they look at belongs to the other line.
template <class T>
bool LineFinder<T>::runs_beside_another(const Followed& line) const {
  const ScaleGroup& g = groups_.all[line.group];
  const std::size_t step = sample_step(line.range);
  std::size_t looked_at = 0, taken = 0;
  for (std::size_t i = line.range.begin; i < line.range.end; i += step) {
    const StripePoint& p = g.lines.points[i];
    ++looked_at;
    for (const double aside : {-1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5}) {
      const auto x = nearest_pixel(p.x + aside * g.kernels->sigma * p.normal_x),
                 y = nearest_pixel(p.y + aside * g.kernels->sigma * p.normal_y);
      if (!search_.image.contains(x, y)) continue;
      const std::uint16_t label = following_.mask(x, y);
      if (label == ExclusionMask::kFree || label == ExclusionMask::kDead || label >= line.first_label)
        continue;
      ++taken;
      break;
    }
  }
  return static_cast<double>(taken) > search_.tuning.most_taken * static_cast<double>(looked_at);
}

/// A grained line that outweighs those before it by far: they may have been grains of it.
template <class T>
void LineFinder<T>::note_grain(const Followed& line) {
  const ScaleGroup& g = groups_.all[line.group];
  const double weight = this->weight(line);
  if (grained_sigma_ == 0 && g.limits.grain > 0 && weight > search_.tuning.main_line * heaviest_) {
    grained_sigma_ = g.kernels->sigma;
    grain_ = g.limits.grain;
  }
  heaviest_ = std::max(heaviest_, weight);
}

template <class T>
void LineFinder<T>::keep_or_reject(const Followed& line, int seed_level) {
  const double least = search_.least_widths * full_width_of(groups_.all[line.group].kernels->sigma);
  if (length(line) >= search_.tuning.least_length * least && !runs_beside_another(line)) {
    ++lines_;
    note_grain(line);
    // An edge or a crumb: the filter of whole lines drops nearly all of them.
    if (is_edge(line) || length(line) < least)
      add_futile(line);
    else if (length(line) * height(line) >= search_.tuning.evident_line * least * strongest_)
      w_.patience.add_line(points_of(line), least / search_.least_widths);
    block(line, search_.tuning.blocked_by_line, 0);
    strongest_ = std::max(strongest_, height(line) * std::min(1.0, length(line) / (3 * least)));
    return;
  }
  add_futile(line);
  block(line, search_.tuning.blocked_by_rejected, seed_level);
  take_back(line);
}

/// No line begins within so many sigma of this one any more, where its flanks would be followed over and
/// over: none that stands out in the pyramid's `finest_level` or a coarser one.
template <class T>
void LineFinder<T>::block(const Followed& line, double sigmas, int finest_level) {
  const auto levels = static_cast<std::uint8_t>(0xFFU << finest_level);
  const ScaleGroup& g = groups_.all[line.group];
  const double reach = sigmas * g.kernels->sigma;
  const std::size_t step = 2;
  for (std::size_t i = line.range.begin; i < line.range.end; i += step) {
    const StripePoint& p = g.lines.points[i];
    for (double aside = -reach; aside <= reach; aside += 3) {
      const auto x = nearest_pixel(p.x + aside * p.normal_x), y = nearest_pixel(p.y + aside * p.normal_y);
      if (search_.image.contains(x, y)) blocked(x, y) |= levels;
    }
  }
}

template <class T>
bool LineFinder<T>::is_untried(const ScaleSeed& seed) {
  const std::uint16_t label = following_.mask(seed.x, seed.y);
  if (label != ExclusionMask::kFree && label != ExclusionMask::kDead) return false;
  return tried(seed.level, seed.x, seed.y) == 0 && (blocked(seed.x, seed.y) & (1U << seed.level)) == 0;
}

template <class T>
void LineFinder<T>::try_seed(const ScaleSeed& seed) {
  tried(seed.level, seed.x, seed.y) = 1;
  const RungRange rungs = rungs_of(seed.level);
  const auto ridge = best_scale(w_.pyramid, kernels_, seed.x, seed.y, rungs.first, rungs.last);
  if (!ridge) {
    w_.patience.add_futile(search_.tuning.futile_seed);
    return;
  }
  std::optional<Followed> line;
  // What stands out may be a single grain, which has a scale of its own.
  if (grained_sigma_ > ridge->sigma) line = follow(group_for(grained_sigma_, 0.01), seed.x, seed.y);
  if (!line) line = follow(group_for(ridge->sigma, search_.tuning.shared_scale), seed.x, seed.y);
  if (line) {
    const double before = length(*line);
    line = at_own_scale(*line, seed.x, seed.y, 1);
    // Only a line that has grown tells its grain.
    if (line && length(*line) > 2 * before) line = at_own_scale(*line, seed.x, seed.y, 2);
  }
  if (line) keep_or_reject(*line, seed.level);
}

/// Tries the seeds in their order, as long as there is hope.
template <class T>
void LineFinder<T>::try_seeds(bool beside_ends) {
  for (const ScaleSeed& seed : w_.seeds) {
    if (labels_.current >= ExclusionMask::kLastLabel || w_.patience.is_over() || has_enough()) return;
    if (seed.rank * search_.brightest < 255 * search_.tuning.faintest_seed * strongest_) return;
    if (!is_untried(seed) || (beside_ends && !w_.patience.is_beside_end(seed.x, seed.y))) continue;
    try_seed(seed);
  }
}

template <class T>
void LineFinder<T>::run() {
  prepare();
  begin();
  try_seeds(false);
  if (grained_sigma_ > 0) {
    const double grain = grain_;
    begin();
    const std::size_t group = group_for(grained_sigma_, 0.01);
    groups_.all[group].limits.grain = grain;
    try_seeds(false);
  }
  if (!w_.patience.is_over()) return;
  w_.patience.look_beside_ends();
  // What is found has ends of its own.
  for (std::size_t before = 0; before < w_.patience.lines() && !w_.patience.is_over();) {
    before = w_.patience.lines();
    try_seeds(true);
  }
}

}  // namespace

template <class T>
void follow_lines_at_own_scale(const OwnScaleSearch<T>& search, const LimitsMaker& limits,
                               KernelCache& kernels, DirectionGuidedWorkspace<T>& following,
                               OwnScaleWorkspace<T>& workspace, ScaleGroups& groups) {
  groups.count = 0;
  if (search.image.empty() || search.brightest <= 0) return;
  LineFinder<T>(search, limits, kernels, following, workspace, groups).run();
}

template void follow_lines_at_own_scale<std::uint8_t>(const OwnScaleSearch<std::uint8_t>&, const LimitsMaker&,
                                                      KernelCache&, DirectionGuidedWorkspace<std::uint8_t>&,
                                                      OwnScaleWorkspace<std::uint8_t>&, ScaleGroups&);
template void follow_lines_at_own_scale<std::uint16_t>(const OwnScaleSearch<std::uint16_t>&,
                                                       const LimitsMaker&, KernelCache&,
                                                       DirectionGuidedWorkspace<std::uint16_t>&,
                                                       OwnScaleWorkspace<std::uint16_t>&, ScaleGroups&);

}  // namespace lightstripe
