// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/follow/direction_guided_step.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "extraction/follow/bridge.h"
#include "extraction/follow/direction_guided_between.h"
#include "extraction/follow/follow_tuning.h"

namespace lightstripe {
namespace {

constexpr const StepTuning& kTuning = kStepTuning;

/// Where following stands.
struct Tip {
  double x = 0, y = 0;
  Direction direction;
  double recent_strength = 0;  ///< decaying maximum
  int disturbed_steps = 0;
  int steady_steps = 0;  ///< plain steps since something else happened
  RidgePlace last;       ///< with steady_steps > 0: the point itself
};

/// Where a line goes on beyond a gap, a crossing or a spot.
struct Landing {
  RidgePlace place;
  int gap = 0;  ///< columns (rows) without a point
};

template <class T>
class Follower {
 public:
  /// `length`: points that the line has on the other side of its start.
  Follower(const RidgeFinder<T>& finder, ExclusionMask& mask, MaskLabels& labels, std::size_t length)
      : finder_(finder),
        limits_(finder.limits),
        mask_(mask),
        labels_(labels),
        previous_(labels.first),
        stride_(evaluation_stride(finder.kernels.sigma)),
        length_before_(static_cast<double>(length)) {
    renew_label();
  }

  /// Appends the points from `start` on; true if they came back to it.
  bool run(const RidgePlace& start, std::vector<StripePoint>& out);

  /// Marks the pixels across the stripe.
  void mark(const RidgePlace& p) {
    const int bin = 1 << finder_.bin_shift;
    const double half = kTuning.marked * finder_.kernels.sigma * bin, middle = 0.5 * (bin - 1);
    for (int k = 0; k < bin; ++k)
      if (p.direction.column_wise())
        mask_.mark_column(nearest_pixel(p.x) * bin + k, p.y * bin + middle, half / std::abs(p.direction.x),
                          labels_.current);
      else
        mask_.mark_row(nearest_pixel(p.y) * bin + k, p.x * bin + middle, half / std::abs(p.direction.y),
                       labels_.current);
  }

 private:
  RidgeSearch predict(const Tip& tip, const Direction& direction, int steps, double aside) const;
  bool is_free(double x, double y) const;
  bool leaves_image(const Tip& tip, const RidgeSearch& ahead) const;
  std::optional<RidgePlace> find_free(const RidgeSearch& search) const;
  std::optional<RidgePlace> beside(const Tip& tip, const RidgeSearch& ahead) const;
  std::optional<RidgePlace> around_corner(const Tip& tip, const RidgeSearch& ahead) const;
  bool meets_line(const Tip& tip) const;
  std::optional<Landing> look_ahead(const Tip& tip, int nearest, bool far) const;
  bool go_on(std::size_t before, Tip& tip, std::vector<StripePoint>& out);
  bool leap(Tip& tip, std::size_t before, bool far, std::vector<StripePoint>& out);
  bool stride(Tip& tip, std::vector<StripePoint>& out);
  void advance(Tip& tip, const RidgePlace& p, std::vector<StripePoint>& out);

  /// Long enough that the marks around a bend's inner side are still recent.
  std::size_t label_length() const { return 8 + static_cast<std::size_t>(6 * finder_.kernels.sigma); }
  void renew_label() {
    if (labels_.current < ExclusionMask::kDead - 1) ++labels_.current;
  }

  const RidgeFinder<T>& finder_;
  const RidgeLimits& limits_;
  ExclusionMask& mask_;
  MaskLabels& labels_;
  std::uint16_t previous_;  ///< at first the other way's label next to the start
  int stride_;              ///< columns (rows) from one evaluation to the next on a plain line
  double length_before_;    ///< points on the other side of the start
  double length_ = 0;       ///< points on both sides
};

/// The place `steps` columns (rows) ahead on the straight continuation, `aside` px beside it.
template <class T>
RidgeSearch Follower<T>::predict(const Tip& tip, const Direction& direction, int steps, double aside) const {
  RidgeSearch s;
  s.direction = direction;
  s.least_strength = std::max(limits_.follow_strength, limits_.relative_strength * tip.recent_strength);
  if (direction.column_wise()) {
    s.x = nearest_pixel(tip.x) + (direction.x > 0 ? steps : -steps);
    s.y = tip.y + direction.y / direction.x * (s.x - tip.x) + aside;
  } else {
    s.y = nearest_pixel(tip.y) + (direction.y > 0 ? steps : -steps);
    s.x = tip.x + direction.x / direction.y * (s.y - tip.y) + aside;
  }
  return s;
}

/// Inside the image, and nothing but the recent part of this line there.
template <class T>
bool Follower<T>::is_free(double x, double y) const {
  const auto column = nearest_pixel(x), row = nearest_pixel(y);
  if (!finder_.image.contains(column, row)) return false;
  const std::uint16_t label = mask_(finder_.in_mask(column), finder_.in_mask(row));
  return label == ExclusionMask::kFree || label == ExclusionMask::kDead || label == labels_.current ||
         label == previous_;
}

/// Ahead lies the outside, which the line does not merely run along: what is found beside the last point, or
/// around a corner, is its own light once more.
template <class T>
bool Follower<T>::leaves_image(const Tip& tip, const RidgeSearch& ahead) const {
  const auto x = nearest_pixel(ahead.x), y = nearest_pixel(ahead.y);
  const double sideways = x < 0 ? -tip.direction.x : x >= finder_.image.width ? tip.direction.x : 0.0;
  const double upright = y < 0 ? -tip.direction.y : y >= finder_.image.height ? tip.direction.y : 0.0;
  return std::max(sideways, upright) > kTuning.leaving_sine;
}

/// The ridge that is found, where neither it nor the place searched is another line's.
template <class T>
std::optional<RidgePlace> Follower<T>::find_free(const RidgeSearch& search) const {
  if (!is_free(search.x, search.y)) return std::nullopt;
  const auto found = finder_.find(search);
  return found && is_free(found->x, found->y) ? found : std::nullopt;
}

/// The paper's step 3: of the predicted place's neighbours the one with the smallest distance + angle
/// difference.
template <class T>
std::optional<RidgePlace> Follower<T>::beside(const Tip& tip, const RidgeSearch& ahead) const {
  std::optional<RidgePlace> best;
  double least_cost = 1e9;
  for (const double aside : {-1.0, 1.0}) {
    RidgeSearch search = predict(tip, tip.direction, 1, aside);
    search.clear_only = true;
    const auto found = find_free(search);
    if (!found) continue;
    const double cost = std::hypot(found->x - ahead.x, found->y - ahead.y) +
                        std::acos(std::clamp(found->direction.dot(tip.direction), -1.0, 1.0));
    if (cost >= least_cost) continue;
    least_cost = cost;
    best = found;
  }
  return best;
}

/// The line may leave by up to a right angle, if it stays about as strong.
template <class T>
std::optional<RidgePlace> Follower<T>::around_corner(const Tip& tip, const RidgeSearch& ahead) const {
  std::optional<RidgePlace> best;
  double nearest = 1e9;
  for (const double angle : {kTuning.corner_angle, -kTuning.corner_angle, kTuning.sharp_corner_angle,
                             -kTuning.sharp_corner_angle}) {
    RidgeSearch search = predict(tip, tip.direction.rotated(std::cos(angle), std::sin(angle)), 1, 0);
    search.clear_only = true;
    search.grain_counts = false;  // grains lie in every direction
    search.least_strength = std::max(search.least_strength, kTuning.corner_strength * tip.recent_strength);
    const auto found = find_free(search);
    if (!found) continue;
    const double distance = std::hypot(found->x - ahead.x, found->y - ahead.y);
    if (distance >= nearest) continue;
    nearest = distance;
    best = found;
  }
  return best;
}

/// Another line's pixels lie ahead. It disturbs the ridge before its mask begins.
template <class T>
bool Follower<T>::meets_line(const Tip& tip) const {
  const double farthest = kTuning.disturbed_by_line_least + kTuning.disturbed_by_line * finder_.kernels.sigma;
  for (int k = 1; k <= static_cast<int>(farthest); ++k) {
    const RidgeSearch ahead = predict(tip, tip.direction, k, 0);
    const auto x = nearest_pixel(ahead.x), y = nearest_pixel(ahead.y);
    if (finder_.image.contains(x, y) && !is_free(x, y)) return true;
  }
  return false;
}

/// The first clear ridge on the straight continuation, from `nearest` steps on, that is followed by more of
/// it.
template <class T>
std::optional<Landing> Follower<T>::look_ahead(const Tip& tip, int nearest, bool far) const {
  const double sigmas = std::min(kTuning.farthest_behind_crossing,
                                 kTuning.farthest_of_first_points + length_ / finder_.kernels.sigma);
  const int farthest = far ? static_cast<int>(sigmas * finder_.kernels.sigma) : limits_.largest_gap;
  const int confirmed_after = far ? 1 + static_cast<int>(finder_.kernels.sigma) : 1;
  const int step =
      far ? std::max(1, static_cast<int>(kTuning.step_behind_crossing * finder_.kernels.sigma)) : 1;
  for (int k = nearest; k <= farthest; k += step) {
    RidgeSearch search = predict(tip, tip.direction, k, 0);
    search.reach = std::min(kTuning.landing_reach + kTuning.landing_spread * k, kTuning.most_landing_reach);
    search.least_cosine = kTuning.landing_cosine;
    search.clear_only = true;
    search.least_strength = std::max(search.least_strength, kTuning.landing_strength * tip.recent_strength);
    const auto found = find_free(search);
    if (!found) continue;
    // One point may be noise, or still be drawn aside by what was crossed: further ones have to agree.
    const Tip landed{found->x, found->y, found->direction, tip.recent_strength, 0, 0, {}};
    RidgeSearch next = predict(landed, landed.direction, confirmed_after, 0);
    next.reach = kTuning.landing_reach;
    next.least_cosine = kTuning.confirmed_cosine;
    next.clear_only = true;
    if (!is_free(next.x, next.y) || !finder_.find(next)) continue;
    return Landing{*found, k - 1};
  }
  return std::nullopt;
}

/// The point takes its place and its direction steers on; a weak point's direction counts less.
template <class T>
void Follower<T>::advance(Tip& tip, const RidgePlace& p, std::vector<StripePoint>& out) {
  const bool clear = p.clarity == RidgeClarity::kClear;
  const double weight = !clear                                 ? 0.0
                        : p.strength >= limits_.clear_strength ? kTuning.clear_weight
                                                               : kTuning.noisy_weight;
  tip.direction = blended(tip.direction, p.direction, weight);
  tip.x = p.x;
  tip.y = p.y;
  tip.recent_strength = std::max(kTuning.remembered_strength * tip.recent_strength, p.strength);
  tip.disturbed_steps = clear ? 0 : tip.disturbed_steps + 1;
  tip.steady_steps = clear ? tip.steady_steps + 1 : 0;
  tip.last = p;
  out.push_back(to_stripe_point(p));
  mark(p);
}

/// Over a gap, a crossing (`far`) or a spot; bridged points fill it, except where a longer stretch is simply
/// dark.
template <class T>
bool Follower<T>::leap(Tip& tip, std::size_t before, bool far, std::vector<StripePoint>& out) {
  // Before a crossing the last points are already drawn aside: they are given up, and the direction is taken
  // from the points before them.
  const std::size_t doubtful =
      far ? static_cast<std::size_t>(kTuning.doubtful_least + kTuning.doubtful * finder_.kernels.sigma) : 0;
  constexpr std::size_t kBase = kTuning.base_points;
  Tip base = tip;
  const bool retreats = doubtful > 0 && out.size() >= before + doubtful + kBase;
  if (retreats) {
    const StripePoint& p = out[out.size() - 1 - doubtful];
    const StripePoint& q = out[out.size() - kBase - doubtful];
    const double dx = p.x - q.x, dy = p.y - q.y, length = std::hypot(dx, dy);
    base = {p.x, p.y, {dx / length, dy / length}, tip.recent_strength, 0, 0, {}};
  }
  // Always beyond the tip, so that following gets on.
  const auto landing = look_ahead(base, retreats ? static_cast<int>(doubtful) + 2 : 2, far);
  if (!landing) return false;
  if (retreats) out.resize(out.size() - doubtful);
  RidgePlace from;
  from.x = base.x;
  from.y = base.y;
  from.direction = base.direction;
  from.strength = base.recent_strength;
  const StripePoint a = to_stripe_point(from), b = to_stripe_point(landing->place);
  if (far || landing->gap <= limits_.largest_filled_gap)
    for (int i = 1; i <= landing->gap; ++i)
      out.push_back(bridged_point(a, b, static_cast<double>(i) / (landing->gap + 1)));
  tip = base;
  tip.direction = landing->place.direction;
  advance(tip, landing->place, out);
  tip.steady_steps = 0;
  return true;
}

/// Where the line runs on plainly, several columns (rows) at once; the points between are interpolated.
template <class T>
bool Follower<T>::stride(Tip& tip, std::vector<StripePoint>& out) {
  if (stride_ == 1 || tip.steady_steps < kTuning.steady_steps) return false;
  const int steady_steps = tip.steady_steps;
  tip.steady_steps = 1;  // unless it goes well, single steps come next
  const RidgeSearch ahead = predict(tip, tip.direction, stride_, 0);
  if (!is_free(ahead.x, ahead.y)) return false;
  const auto found = finder_.find(ahead);
  if (!found || found->clarity != RidgeClarity::kClear ||
      found->direction.column_wise() != tip.last.direction.column_wise() ||
      tip.last.direction.column_wise() != tip.direction.column_wise() ||
      found->strength < kTuning.stride_strength * tip.recent_strength)
    return false;
  append_between(tip.last, *found, stride_, out);
  advance(tip, *found, out);
  tip.steady_steps = steady_steps;
  return true;
}

/// One step; false at the end of the line.
template <class T>
bool Follower<T>::go_on(std::size_t before, Tip& tip, std::vector<StripePoint>& out) {
  if (stride(tip, out)) return true;
  const RidgeSearch ahead = predict(tip, tip.direction, 1, 0);
  if (leaves_image(tip, ahead)) return false;
  const auto found = is_free(ahead.x, ahead.y) ? finder_.find(ahead) : std::nullopt;
  const bool disturbed = found && found->clarity == RidgeClarity::kDisturbed;
  if (found && !disturbed) {
    advance(tip, *found, out);
    return true;
  }
  const bool far = disturbed || meets_line(tip);
  if (far && leap(tip, before, true, out)) return true;
  if (disturbed && tip.disturbed_steps < static_cast<int>(kTuning.disturbed_steps_least +
                                                          kTuning.disturbed_steps * finder_.kernels.sigma)) {
    advance(tip, *found, out);
    return true;
  }
  auto next = beside(tip, ahead);
  if (!next) next = around_corner(tip, ahead);
  if (next) {
    advance(tip, *next, out);
    tip.steady_steps = 0;
    return true;
  }
  return !far && leap(tip, before, false, out);
}

template <class T>
bool Follower<T>::run(const RidgePlace& start, std::vector<StripePoint>& out) {
  constexpr std::size_t kWindow = kTuning.curl_window;
  const std::size_t before = out.size();
  const std::size_t most = 4 * static_cast<std::size_t>(finder_.image.width + finder_.image.height);
  Tip tip{start.x, start.y, start.direction, start.strength, 0, 0, {}};
  std::size_t next_label = label_length();
  while (out.size() - before < most) {
    length_ = length_before_ + static_cast<double>(out.size() - before);
    if (!go_on(before, tip, out)) return false;
    const std::size_t steps = out.size() - before;
    if (steps > kTuning.least_closed && std::abs(tip.x - start.x) <= stride_ &&
        std::abs(tip.y - start.y) <= stride_)
      return true;
    // Curling up on a spot instead of going on.
    if (steps > kWindow) {
      const StripePoint& past = out[out.size() - 1 - kWindow];
      const double dx = past.x - tip.x, dy = past.y - tip.y;
      if (dx * dx + dy * dy < kTuning.curl_advance * kTuning.curl_advance * kWindow * kWindow) return false;
    }
    if (steps < next_label) continue;
    next_label += label_length();
    previous_ = labels_.current;
    renew_label();
  }
  return false;
}

}  // namespace

template <class T>
bool follow_one_way(const RidgeFinder<T>& finder, const RidgePlace& start, bool forward, std::size_t behind,
                    ExclusionMask& mask, MaskLabels& labels, std::vector<StripePoint>& out) {
  Follower<T> follower(finder, mask, labels, behind);
  RidgePlace first = start;
  if (!forward) first.direction = {-start.direction.x, -start.direction.y};
  follower.mark(first);
  const std::size_t begin = out.size();
  const bool closed = follower.run(first, out);
  // Normals turn with the line's sense, which is the start's.
  for (std::size_t i = begin; !forward && i < out.size(); ++i) {
    out[i].normal_x = -out[i].normal_x;
    out[i].normal_y = -out[i].normal_y;
  }
  return closed;
}

template bool follow_one_way<std::uint8_t>(const RidgeFinder<std::uint8_t>&, const RidgePlace&, bool,
                                           std::size_t, ExclusionMask&, MaskLabels&,
                                           std::vector<StripePoint>&);
template bool follow_one_way<std::uint16_t>(const RidgeFinder<std::uint16_t>&, const RidgePlace&, bool,
                                            std::size_t, ExclusionMask&, MaskLabels&,
                                            std::vector<StripePoint>&);

}  // namespace lightstripe
