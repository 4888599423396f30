// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/line_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "extraction/follow/bridge.h"
#include "extraction/follow/direction_guided_ridge.h"
#include "extraction/image/background.h"
#include "extraction/kernels/width_rule.h"
#include "extraction/lines/line_measure.h"
#include "extraction/lines/ranked_value.h"

namespace lightstripe {
namespace {

/// Pixel noise that remains in the 1:2:1 mean at the centre of a profile.
constexpr double kTopNoise = 0.62;
/// Of the smaller over the larger drop: an edge drops on one side only; a line on a step of its own height
/// has 0.33.
constexpr double kLeastFlanks = 0.3;
/// Rise of the laser's colour over the rise of the grey value: laser light has 0.2 to 0.9 (0.12 where it is
/// nearly clipped), the edges of printed things in its glow less than 0.06.
constexpr double kLeastColour = 0.08;
/// Of min_length: shorter lines are not looked at further in a colour picture.
constexpr double kShortest = 0.5;
/// Full widths: a stretch in other light that is longer is no part of the line.
constexpr double kLongestOther = 1.5;

struct Trial {
  const DerivativeKernels& kernels;
  const LineFilterRule& rule;
  const LineFilterOptions& options;
  LineFilterWorkspace& w;
  double full_width;  ///< px, of the stripes of this image
  bool colour_known = false;
  double profile_noise = 0;  ///< grey levels, of the line on trial: less where its profiles were averaged

  /// Median of the contrasts at i - 1, i, i + 1 inside the range.
  double contrast(const LineRange& r, std::size_t i) const {
    const std::size_t a = i > r.begin ? i - 1 : i, b = i + 1 < r.end ? i + 1 : i;
    return median_of_three(w.measure.contrast[a], w.measure.contrast[i], w.measure.contrast[b]);
  }
  static double median_of_three(double a, double b, double c) {
    return std::max(std::min(a, b), std::min(std::max(a, b), c));
  }
};

/// Whether light is there, unsmoothed: the kernels see a line's end up to sigma beyond it.
bool has_contrast(const Trial& t, const LineRange& r, std::size_t i) {
  return t.contrast(r, i) >= 2.5 * kTopNoise * t.profile_noise;
}
bool has_colour(const Trial& t, std::size_t i) {
  return t.w.colour[i] != LaserPlace::kNone && t.w.colour[i] != LaserPlace::kOtherLight;
}
/// Whether the stripe itself is there.
bool is_lit(const Trial& t, const LineRange& r, std::size_t i) {
  return has_contrast(t, r, i) && has_colour(t, i);
}

/// Cuts unlit and bridged points off both ends. A lit end has half the contrast of the line a little further
/// in: what is darker was only blurred over the end. Where it is dark there, the end is a spot that was met
/// by chance.
LineRange trimmed(const Trial& t, const LineSet& lines, LineRange r) {
  const auto inside = static_cast<std::size_t>(std::lround(2.0 * t.kernels.sigma)) + 1;
  const auto bad = [&](std::size_t i, std::size_t further_in) {
    return (lines.points[i].flags & kStripeBridged) != 0 || !is_lit(t, r, i) ||
           !has_contrast(t, r, further_in) || t.contrast(r, i) < 0.5 * t.contrast(r, further_in);
  };
  while (r.size() > inside && bad(r.begin, r.begin + inside)) ++r.begin;
  while (r.size() > inside && bad(r.end - 1, r.end - 1 - inside)) --r.end;
  return r.size() > inside ? r : LineRange{r.begin, r.begin};
}

double median_width(Trial& t, const LineSet& lines, const LineRange& r) {
  t.w.scratch.clear();
  for (std::size_t i = r.begin; i < r.end; i += sample_step(r))
    if ((lines.points[i].flags & kStripeBridged) == 0)
      t.w.scratch.push_back(static_cast<float>(lines.points[i].width));
  return ranked_median(t.w.scratch);
}

/// How far a bridge runs beside the light that was measured there, px.
double beside_light(const StripePoint& bridge, const StripePoint& seen) {
  if ((seen.flags & kStripeBridged) != 0) return 0;
  return std::abs((bridge.x - seen.x) * seen.normal_x + (bridge.y - seen.y) * seen.normal_y);
}

/// Replaces the points between two, in a spot on a line of this width, by a cubic that continues both sides;
/// false where they do not fit. The light of a spot may hide the line, or be the line, which is higher there:
/// as likely one as the other; sigma_px says so, and predict_errors() adds the rest. Where the line, on
/// the bridge, could not lie inside the light at all, it is the line.
bool bridge_spot(std::vector<StripePoint>& points, std::size_t before, std::size_t after, double width) {
  constexpr double kUnsure = 0.25;  // of the line's width: where the spot and the line part
  if (!can_bridge(points[before], points[after])) return false;
  const auto bridge = [&](std::size_t i) {
    return bridged_point(points[before], points[after],
                         static_cast<double>(i - before) / static_cast<double>(after - before));
  };
  for (std::size_t i = before + 1; i < after; ++i)
    if (beside_light(bridge(i), points[i]) > 0.5 * std::max(0.0, points[i].width - width) + kUnsure * width)
      return false;
  for (std::size_t i = before + 1; i < after; ++i) {
    StripePoint p = bridge(i);
    p.sigma_px = beside_light(p, points[i]) / std::numbers::sqrt2;
    points[i] = p;
  }
  return true;
}

/// One kept stretch of a line.
void keep(Trial& t, const LineSet& lines, LineRange r) {
  r = trimmed(t, lines, r);
  if (r.size() >= 3) t.w.kept.push_back(r);
}

/// Share of the range's points that have one of these flags.
double flagged_share(const LineSet& lines, const LineRange& r, int flags) {
  std::size_t flagged = 0;
  for (std::size_t i = r.begin; i < r.end; ++i) flagged += (lines.points[i].flags & flags) != 0 ? 1U : 0U;
  return static_cast<double>(flagged) / static_cast<double>(r.size());
}

/// Cheap test: if no single point is bad, no median of three can be.
bool has_bad_point(const Trial& t, const LineSet& lines, const LineRange& r, double width) {
  const double lit = 2.5 * kTopNoise * t.profile_noise;
  for (std::size_t i = r.begin; i < r.end; ++i)
    if (lines.points[i].width > width || static_cast<double>(t.w.measure.contrast[i]) < lit ||
        !has_colour(t, i))
      return true;
  return false;
}

/// The bad stretches of a line, those closer than `least_run` good points joined.
void find_bad_stretches(Trial& t, const LineSet& lines, const LineRange& r, std::size_t least_run,
                        std::vector<BadStretch>& stretches) {
  const double width = median_width(t, lines, r);
  const double spot_width = t.options.spot_width_ratio * width;
  // Where the line itself is not clipped, a clipped stretch needs less to be a spot.
  const bool clipped_is_odd = flagged_share(lines, r, kStripeSaturated) < 0.25;
  const double clipped_spot_width = clipped_is_odd ? 0.5 * (width + spot_width) : spot_width;
  stretches.clear();
  if (!has_bad_point(t, lines, r, std::min(clipped_spot_width, spot_width))) return;
  for (std::size_t i = r.begin; i < r.end; ++i) {
    const StripePoint &p = lines.points[i], &a = lines.points[i > r.begin ? i - 1 : i],
                      &b = lines.points[i + 1 < r.end ? i + 1 : i];
    const bool clipped = (p.flags & kStripeSaturated) != 0;
    const bool wide =
        Trial::median_of_three(a.width, p.width, b.width) > (clipped ? clipped_spot_width : spot_width);
    if (!wide && is_lit(t, r, i)) continue;
    if (stretches.empty() || i - stretches.back().last > (wide || stretches.back().spot ? least_run : 1))
      stretches.push_back({i, i, wide, 0});
    stretches.back().last = i;
    stretches.back().other_light += t.w.colour[i] == LaserPlace::kOtherLight ? 1U : 0U;
    stretches.back().spot = stretches.back().spot || wide;
  }
}

double stretch_width(Trial& t, const LineSet& lines, const BadStretch& bad) {
  return median_width(t, lines, {bad.first, bad.last + 1});
}

/// A line that is lit over some length by other light than the laser's was followed along an edge.
bool is_other_light(const Trial& t, const BadStretch& bad) {
  const std::size_t size = bad.last - bad.first + 1;
  return 2 * bad.other_light > size && static_cast<double>(size) > kLongestOther * t.full_width;
}

/// Bright spots on the line: bridged where both sides agree, else the line is cut there. Long unlit stretches
/// cut, too.
void mend_or_cut(Trial& t, LineSet& lines, const LineRange& whole) {
  const LineRange r = trimmed(t, lines, whole);
  if (r.size() < 3) return;
  const auto longest = static_cast<std::size_t>(t.options.max_spot_widths * t.full_width);
  const auto margin = static_cast<std::size_t>(std::lround(t.kernels.sigma));
  const auto least_run = static_cast<std::size_t>(std::lround(1.5 * t.full_width));
  find_bad_stretches(t, lines, r, least_run, t.w.stretches);
  const double width = t.w.stretches.empty() ? 0 : median_width(t, lines, r);
  std::size_t begin = r.begin;
  for (const BadStretch& bad : t.w.stretches) {
    const bool other_light = is_other_light(t, bad);
    if (!bad.spot && bad.last - bad.first < longest && !other_light) {
      // Dark, but the kernels followed a ridge there: it stays as a bridge.
      for (std::size_t k = bad.first; k <= bad.last; ++k) lines.points[k].flags |= kStripeBridged;
      continue;
    }
    const std::size_t grown = bad.spot ? margin + 1 : 1;
    const std::size_t before = bad.first > begin + grown ? bad.first - grown : begin;
    const std::size_t after = std::min(bad.last + grown, r.end);
    // A short rest behind a spot is the spot's own tip.
    const bool inside = before >= begin + least_run && after + least_run <= r.end;
    if (!other_light && inside && bad.last - bad.first < longest &&
        bridge_spot(lines.points, before, after, width))
      continue;
    // Bloom widens the line, but it goes on inside.
    if (bad.spot && !other_light && stretch_width(t, lines, bad) < 2 * t.options.spot_width_ratio * width)
      continue;
    keep(t, lines, {begin, before});
    begin = after;
  }
  keep(t, lines, {begin, r.end});
}

/// The intensity that a quarter of the points exceed: half of a line over a checkerboard lies on black
/// squares.
double typical_intensity(Trial& t, const LineSet& lines, const LineRange& r) {
  t.w.scratch.clear();
  for (std::size_t i = r.begin; i < r.end; i += sample_step(r))
    if ((lines.points[i].flags & kStripeBridged) == 0) t.w.scratch.push_back(lines.points[i].intensity);
  if (t.w.scratch.empty()) return 0;
  return ranked_value(t.w.scratch, t.w.scratch.size() * 3 / 4);
}

/// Median over the line's points, bridged or not, of what `value` gives for the i-th.
template <class Value>
double sampled_median(const LineRange& r, std::vector<float>& scratch, const Value& value) {
  scratch.clear();
  for (std::size_t i = r.begin; i < r.end; i += sample_step(r)) scratch.push_back(value(i));
  return ranked_median(scratch);
}

/// Median width at half height over that of the foot: how flat the top is.
double flatness(Trial& t, const LineSet& lines, const LineRange& r) {
  return sampled_median(r, t.w.scratch, [&](std::size_t i) {
    return lines.half_level_widths[i] / std::max(1.0F, static_cast<float>(lines.points[i].width));
  });
}

/// Median over the line of the smaller over the larger drop from the ridge to both sides.
double flank_ratio(Trial& t, const LineSet& lines, const LineRange& r) {
  t.w.scratch.clear();
  for (std::size_t i = r.begin; i < r.end; i += sample_step(r)) {
    const StripePoint& p = lines.points[i];
    if ((p.flags & kStripeBridged) != 0) continue;
    const float smaller = t.w.measure.contrast[i], larger = 2 * p.intensity - smaller;
    t.w.scratch.push_back(larger > 0 ? std::max(smaller, 0.0F) / larger : 0.0F);
  }
  return t.w.scratch.empty() ? 1.0 : ranked_median(t.w.scratch);
}

/// Median grey value of the pixels that the line runs through.
template <class T>
double median_level(ImageView<T> image, const LineSet& lines, const LineRange& r,
                    std::vector<float>& scratch) {
  return sampled_median(r, scratch, [&](std::size_t i) {
    const NearestPixel at = nearest_inside(image, lines.points[i].x, lines.points[i].y);
    return static_cast<float>(image(at.x, at.y));
  });
}

LineFacts facts_of(Trial& t, const LineSet& lines, const LineRange& r) {
  constexpr std::size_t kChord = 4;  // points; shorter chords would add up the noise as well
  LineFacts facts;
  for (std::size_t i = r.begin; i + 1 < r.end; i += kChord) {
    const StripePoint &p = lines.points[i], &next = lines.points[std::min(i + kChord, r.end - 1)];
    const double dx = next.x - p.x, dy = next.y - p.y;
    facts.length += std::sqrt(dx * dx + dy * dy);
  }
  std::size_t bridged = 0, odd = 0, clipped = 0, coloured = 0;
  for (std::size_t i = r.begin; i < r.end; ++i) {
    const StripePoint& p = lines.points[i];
    bridged += (p.flags & kStripeBridged) != 0 ? 1U : 0U;
    odd += (p.flags & (kStripeBridged | kStripeAsymmetric)) != 0 ? 1U : 0U;
    clipped += (p.flags & kStripeSaturated) != 0 ? 1U : 0U;
    coloured += has_colour(t, i) ? 1U : 0U;
    facts.mean_strength += p.strength;
  }
  const auto count = static_cast<double>(r.size());
  facts.mean_strength /= count;
  facts.bridged_share = static_cast<double>(bridged) / count;
  facts.odd_share = static_cast<double>(odd) / count;
  facts.clipped_share = static_cast<double>(clipped) / count;
  facts.coloured_share = static_cast<double>(coloured) / count;
  facts.colour_known = t.colour_known;
  facts.flatness = flatness(t, lines, r);
  facts.flanks = flank_ratio(t, lines, r);
  facts.width = median_width(t, lines, r);
  facts.intensity = typical_intensity(t, lines, r);
  return facts;
}

/// What a codec that keeps little of the colour, or a tone curve, leaves of a line: hardly any colour, though
/// the line is so long and even that nothing else looks like it, or as bright as the picture can be, with
/// darkness or some colour beside it.
bool has_lost_colour(const Trial& t, const LineFacts& line) {
  constexpr double kLeastLeft = 0.02;                    // of the rise of the grey value
  constexpr double kTop = 0.93, kOverSides = 0.75;       // of the brightest level
  constexpr double kFlatTop = 0.75;                      // where the range ends; a Gaussian has 0.68
  constexpr double kEvident = 6, kEvidentWhenTop = 2.5;  // of min_length
  if (!line.colour.known || line.colour.share > kUsualColour) return false;
  const double evident = line.even_length() / (t.options.min_length * t.full_width);
  const bool has_some = line.colour.share > kLeastLeft,
             at_top = line.level > kTop * t.rule.brightest && line.flatness > kFlatTop &&
                      (has_some || line.intensity > kOverSides * t.rule.brightest);
  return at_top ? evident > kEvidentWhenTop : has_some && evident > kEvident;
}

/// Length and width tests, which need no other line; a short line has to be the more regular.
bool is_stripe_like(const Trial& t, const LineFacts& line) {
  // Lines of their own scale are judged by length and brightness together, later on.
  const double least = t.rule.width_slack > 1 && line.colour_known ? kShortest : 1.0;
  if (line.length < least * t.options.min_length * t.full_width || line.bridged_share > 0.5) return false;
  if (line.flanks < kLeastFlanks || line.coloured_share < 0.5) return false;
  if (line.colour.known && line.colour.share < kLeastColour) return false;
  const double ratio = std::max(line.width, 1e-3) / t.full_width;
  const double most =
      line.length < 12 * t.full_width ? 0.75 * t.options.max_width_ratio : t.options.max_width_ratio;
  return ratio < t.rule.width_slack * most && 1.0 / ratio < 1.5 * t.rule.width_slack * most;
}

/// A column (row) of the sensor that is defective: exactly straight, exactly on the pixels, and narrower than
/// any lens draws a line.
bool is_hot_column(const LineSet& lines, const LineRange& r, const LineFacts& facts) {
  constexpr double kWidth = 1.9, kOnPixel = 0.1;  // px
  if (facts.width > kWidth) return false;
  const StripePoint& first = lines.points[r.begin];
  const bool column = std::abs(first.normal_x) > std::abs(first.normal_y);
  const double at = std::round(column ? first.x : first.y);
  for (std::size_t i = r.begin; i < r.end; i += sample_step(r))
    if (std::abs((column ? lines.points[i].x : lines.points[i].y) - at) > kOnPixel) return false;
  return true;
}

/// Points that were clipped before their background was taken away.
void flag_clipped(const Trial& t, const LineRange& r, LineSet& lines) {
  for (std::size_t i = r.begin; i < r.end; ++i)
    if (t.w.colour[i] == LaserPlace::kClipped) lines.points[i].flags |= kStripeSaturated;
}

}  // namespace

void drop_lines(LineSet& lines, std::vector<LineFacts>& facts) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < lines.lines.size(); ++k) {
    if (!facts[k].kept) continue;
    lines.lines[kept] = lines.lines[k];
    facts[kept++] = facts[k];
  }
  lines.lines.resize(kept);
  facts.resize(kept);
}

template <class T>
void filter_lines(ImageView<T> image, const DerivativeKernels& kernels, const LineFilterRule& rule,
                  const LineFilterOptions& options, LineFilterWorkspace& workspace, LineSet& lines,
                  std::vector<LineFacts>& facts) {
  Trial trial{kernels, rule, options, workspace, full_width_of(kernels.sigma), image.where != nullptr};
  measure_points(image, kernels, rule.noise, lines, workspace.measure);
  workspace.colour.assign(lines.points.size(), LaserPlace::kSure);
  workspace.tried += lines.lines.size();
  workspace.kept.clear();
  for (std::size_t k = 0; k < lines.lines.size(); ++k) {
    trial.profile_noise = rule.noise / std::sqrt(workspace.measure.averaged[k]);
    if (trial.colour_known) {
      place_points(image, lines, lines.lines[k], median_width(trial, lines, lines.lines[k]),
                   workspace.colours, workspace.colour);
      flag_clipped(trial, lines.lines[k], lines);
    }
    mend_or_cut(trial, lines, lines.lines[k]);
  }
  std::swap(lines.lines, workspace.kept);
  facts.clear();
  for (const LineRange& r : lines.lines) {
    LineFacts& line = facts.emplace_back(facts_of(trial, lines, r));
    line.level = median_level(image, lines, r, workspace.scratch);
    line.colour = colour_of_line(image, lines, r, line.width, workspace.colours);
    if (rule.width_slack > 1 && is_hot_column(lines, r, line)) line.length = 0;
    if (line.flanks >= kLeastFlanks) continue;
    workspace.edges.length += line.length;
    workspace.edges.weighted_height += 2 * line.intensity * line.length;
    workspace.edges.weighted_level += line.level * line.length;
  }
  for (LineFacts& line : facts) {
    if (has_lost_colour(trial, line)) line.colour = {};
    line.kept = is_stripe_like(trial, line);
  }
  drop_lines(lines, facts);
}

template void filter_lines<std::uint8_t>(ImageView8, const DerivativeKernels&, const LineFilterRule&,
                                         const LineFilterOptions&, LineFilterWorkspace&, LineSet&,
                                         std::vector<LineFacts>&);
template void filter_lines<std::uint16_t>(ImageView16, const DerivativeKernels&, const LineFilterRule&,
                                          const LineFilterOptions&, LineFilterWorkspace&, LineSet&,
                                          std::vector<LineFacts>&);

}  // namespace lightstripe
