// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/follow/own_scale.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "extraction/follow/direction_guided_between.h"
#include "extraction/follow/line_looks.h"
#include "extraction/kernels/width_rule.h"
#include "extraction/lines/line_measure.h"

namespace lightstripe {
namespace {

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
  void lift(const Followed& line);
  Followed put_back(Followed line);
  void block(const Followed& line, double sigmas, int finest_level);
  std::uint8_t& blocked(int x, int y) {
    const auto columns = static_cast<std::size_t>(search_.image.width / 4 + 1);
    return w_.blocked[static_cast<std::size_t>(y / 4) * columns + static_cast<std::size_t>(x / 4)];
  }
  Followed at_own_scale(const Followed& line, double least_broader = 1);
  double grain_of(const Followed& line, double width_scale);
  void allow_for_grain(std::size_t group, double weight, double grain, double broader);
  double length(const Followed& line) const { return static_cast<double>(line.range.size()); }
  std::span<const StripePoint> points_of(const Followed& line) const {
    return {groups_.all[line.group].lines.points.data() + line.range.begin, line.range.size()};
  }
  void add_futile(const Followed& line) {
    following_.patience.add_futile(search_.tuning.futile_line +
                                   length(line) / groups_.all[line.group].kernels->sigma);
  }
  double height(const Followed& line) const {
    return mean_strength(points_of(line)) / groups_.all[line.group].kernels->matched_strength();
  }
  double weight(const Followed& line) const { return length(line) * height(line); }
  /// So short and faint against the strongest line that the filter of whole lines drops it at any scale.
  bool is_hopeless(const Followed& line) const {
    const double least = search_.least_widths * full_width_of(groups_.all[line.group].kernels->sigma);
    return weight(line) < search_.tuning.hopeless * least * strongest_;
  }
  void note_grain(const Followed& line);
  void keep_or_reject(const Followed& line, int seed_level);
  void reject(const Followed& line, int seed_level);
  bool is_untried(const ScaleSeed& seed);
  void try_seed(const ScaleSeed& seed);
  void try_seeds(bool beside_ends);
  void try_chains();
  bool has_enough() const { return search_.stop_after > 0 && lines_ >= search_.stop_after; }

  const OwnScaleSearch<T>& search_;
  const LimitsMaker& limits_;
  KernelCache& kernels_;
  DirectionGuidedWorkspace<T>& following_;
  OwnScaleWorkspace<T>& w_;
  ScaleGroups& groups_;
  MaskLabels labels_;
  int lines_ = 0;
  /// Grey levels, height of the strongest line; the largest length times height, px times grey levels.
  double strongest_ = 0, heaviest_ = 0;
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
  for (int level = 0; level < w_.pyramid.count; ++level)
    if (search_.windowed == nullptr || level <= search_.windowed->coarsest)
      collect_scale_seeds(w_.pyramid, level, {search_.brightest, windows}, following_.seeds, w_.found);
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
  following_.patience.reset(search_.image.width, search_.image.height, search_.tuning);
  groups_.count = groups_.rejected = 0;
  labels_ = {};
  strongest_ = heaviest_ = 0;
  lines_ = 0;
}

template <class T>
std::uint8_t& LineFinder<T>::tried(int level, int x, int y) {
  const auto k = static_cast<std::size_t>(level);
  const ImageView<T> image = w_.pyramid.levels[k];
  const int column = std::clamp(x >> (level + kTriedCellShift), 0, image.width / 4),
            row = std::clamp(y >> (level + kTriedCellShift), 0, image.height / 4);
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

/// The same, as long as the line may still come back.
template <class T>
void LineFinder<T>::lift(const Followed& line) {
  LineSet& lines = groups_.all[line.group].lines;
  w_.lifted_points.assign(lines.points.begin() + static_cast<std::ptrdiff_t>(line.range.begin),
                          lines.points.end());
  lines.lines.pop_back();
  lines.points.resize(line.range.begin);
  following_.mask.lift(line.checkpoint, line.first_label, labels_.current, w_.lifted_marks);
}

/// The line that was lifted stands as it did.
template <class T>
typename LineFinder<T>::Followed LineFinder<T>::put_back(Followed line) {
  LineSet& lines = groups_.all[line.group].lines;
  lines.points.insert(lines.points.end(), w_.lifted_points.begin(), w_.lifted_points.end());
  lines.lines.push_back(line.range);
  following_.mask.put_back(w_.lifted_marks);
  return line;
}

/// How much a line's strength varies by the grain of its light, as a share of it. `width_scale`: the scale
/// that the stripe's width asks for.
template <class T>
double LineFinder<T>::grain_of(const Followed& line, double width_scale) {
  const ScaleGroup& g = groups_.all[line.group];
  const std::span<const StripePoint> points = points_of(line);
  const double bin = 1 << g.level, noise = w_.pyramid.noise[static_cast<std::size_t>(g.level)] *
                                           g.binned_kernels->curvature_gain / (bin * bin);
  // The strength of a clipped bar varies with its outline, that of a thin line with its place between pixels.
  if (width_scale < search_.tuning.thinnest_grained ||
      is_clipped(search_.image, points, search_.tuning.clipped_level * search_.brightest))
    return 0;
  return grain_of_line(points, g.kernels->sigma, noise, w_.values);
}

/// Where the picture's main line is coarsely grained, so much is allowed to its kernels: the grain varies the
/// curvature along a line as much as that across it.
template <class T>
void LineFinder<T>::allow_for_grain(std::size_t group, double weight, double grain, double broader) {
  const FollowTuning& t = search_.tuning;
  if (grain < t.main_grain || weight < heaviest_) return;
  RidgeLimits& limits = groups_.all[group].limits;
  limits.grain = std::max(limits.grain, grain / std::pow(broader, t.grain_falls));
}

/// The line followed again at its own scale, where that differs and does not lose much of it.
template <class T>
typename LineFinder<T>::Followed LineFinder<T>::at_own_scale(const Followed& line, double least_broader) {
  const LineSet& lines = groups_.all[line.group].lines;
  const std::span<const StripePoint> points = points_of(line);
  const double used = groups_.all[line.group].kernels->sigma;
  const double farthest = std::exp2(search_.tuning.farthest_scale);
  const double width_scale = scale_of_line(w_.pyramid, kernels_, points, used);
  const double seen = grain_of(line, width_scale);
  const double grain = seen * std::pow(used / width_scale, search_.tuning.grain_falls);
  const double broader = broader_in_grain(search_.tuning, grained_sigma_ > 0 ? grain : seen);
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
  lift(line);
  const std::size_t group = group_for(own, 0.5 * tolerance);
  allow_for_grain(group, weight_before, grain, broader);
  for (const StripePoint& p : places) {
    const auto again = follow(group, nearest_pixel(p.x), nearest_pixel(p.y));
    if (again && length(*again) >= least) return *again;
    if (again) take_back(*again);
    if (again || broader <= 1 || length(line) < search_.tuning.worth_other_places * own) break;
  }
  return put_back(line);
}

/// A grained line that outweighs those before it: they may have been grains of it.
template <class T>
void LineFinder<T>::note_grain(const Followed& line) {
  const ScaleGroup& g = groups_.all[line.group];
  if (grained_sigma_ == 0 && g.limits.grain > 0 && weight(line) > heaviest_) {
    grained_sigma_ = g.kernels->sigma;
    grain_ = g.limits.grain;
  }
  heaviest_ = std::max(heaviest_, weight(line));
}

template <class T>
void LineFinder<T>::keep_or_reject(const Followed& line, int seed_level) {
  const double sigma = groups_.all[line.group].kernels->sigma,
               least = search_.least_widths * full_width_of(sigma);
  if (length(line) < search_.tuning.least_length * least ||
      runs_beside_another(search_.image, following_.mask, points_of(line), sigma, line.first_label,
                          search_.tuning.most_taken))
    return reject(line, seed_level);
  ++lines_;
  note_grain(line);
  // An edge or a crumb: the filter of whole lines drops nearly all of them.
  if (is_edge(search_.image, points_of(line), sigma) || length(line) < least)
    add_futile(line);
  else if (length(line) * height(line) >= search_.tuning.evident_line * least * strongest_)
    following_.patience.add_line(points_of(line), least / search_.least_widths);
  block(line, search_.tuning.blocked_by_line, 0);
  strongest_ = std::max(strongest_, height(line) * std::min(1.0, length(line) / (3 * least)));
}

template <class T>
void LineFinder<T>::reject(const Followed& line, int seed_level) {
  ++groups_.rejected;
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
  constexpr std::size_t kStep = 2;
  for (std::size_t i = line.range.begin; i < line.range.end; i += kStep) {
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
  if (!ridge) return following_.patience.add_futile(search_.tuning.futile_seed);
  std::optional<Followed> line;
  // What stands out may be a single grain, which has a scale of its own.
  if (grained_sigma_ > ridge->sigma) line = follow(group_for(grained_sigma_, 0.01), seed.x, seed.y);
  if (!line) line = follow(group_for(ridge->sigma, search_.tuning.shared_scale), seed.x, seed.y);
  if (!line) return following_.patience.add_futile(search_.tuning.futile_seed);
  if (is_hopeless(*line)) return reject(*line, seed.level);
  Followed own = at_own_scale(*line);
  // Only a line that has grown tells its grain.
  if (length(own) > 2 * length(*line)) own = at_own_scale(own, 2);
  keep_or_reject(own, seed.level);
}

/// Tries the seeds that lie in a row, the longest row first: where many things are brighter than the line, it
/// shows by its length.
template <class T>
void LineFinder<T>::try_chains() {
  if (search_.windowed != nullptr) return;
  const ImageView<T>& image = search_.image;
  const double least = search_.tuning.least_chain * std::min(image.width, image.height);
  collect_chained_seeds(w_.seeds, image.width, image.height, static_cast<int>(least), w_.chains, w_.chained);
  for (const ScaleSeed& seed : w_.chained) {
    if (!is_untried(seed)) continue;
    if (labels_.current >= ExclusionMask::kLastLabel || following_.patience.is_over() || has_enough()) return;
    const std::size_t before = following_.patience.lines();
    try_seed(seed);
    if (following_.patience.lines() > before) following_.patience.look_along_chains();
  }
}

/// Tries the seeds in their order, as long as there is hope.
template <class T>
void LineFinder<T>::try_seeds(bool beside_ends) {
  for (const ScaleSeed& seed : w_.seeds) {
    if (!is_untried(seed)) continue;
    if (labels_.current >= ExclusionMask::kLastLabel || following_.patience.is_over() || has_enough()) return;
    if (seed.rank * search_.brightest < 255 * search_.tuning.faintest_seed * strongest_) return;
    if (beside_ends && !following_.patience.is_beside_end(seed.x, seed.y)) continue;
    if (!beside_ends && following_.patience.sees_crumbs_only())
      following_.patience.try_chains([this] { try_chains(); });
    try_seed(seed);
  }
}

template <class T>
void LineFinder<T>::run() {
  prepare();
  begin();
  try_seeds(false);
  if (grained_sigma_ > 0) {
    // From the start, with what is known now: single grains took the line's places.
    begin();
    groups_.all[group_for(grained_sigma_, 0.01)].limits.grain = grain_;
    try_seeds(false);
  }
  if (!following_.patience.is_over()) return;
  following_.patience.try_beside_ends([this] { try_seeds(true); });
  following_.patience.try_chains([this] { try_chains(); });
}

}  // namespace

template <class T>
void follow_lines_at_own_scale(const OwnScaleSearch<T>& search, const LimitsMaker& limits,
                               KernelCache& kernels, DirectionGuidedWorkspace<T>& following,
                               OwnScaleWorkspace<T>& workspace, ScaleGroups& groups) {
  groups.count = groups.rejected = 0;
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
