// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/line_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "extraction/follow/bridge.h"
#include "extraction/kernels/width_rule.h"
#include "extraction/lines/line_measure.h"

namespace lightstripe {
namespace {

/// Pixel noise that remains in the 1:2:1 mean at the centre of a profile.
constexpr double kTopNoise = 0.62;
/// Of the smaller over the larger drop: an edge drops on one side only; a line on a step of its own height
/// has 0.33.
constexpr double kLeastFlanks = 0.3;
/// Of the mean height of a crowd of edges, and how long they are together against the lines to be a crowd.
constexpr double kOverEdges = 1.2, kManyEdges = 0.25;
/// Of min_length, where the whole evidence is judged as well.
constexpr double kShortest = 0.5, kColouredEvidence = 0.4, kGreyEvidence = 0.6;

struct Trial {
  const DerivativeKernels& kernels;
  double noise;
  const LineFilterOptions& options;
  LineFilterWorkspace& w;
  double full_width;  ///< px, of the stripes of this image
  double width_slack = 1;
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

/// Whether the stripe itself is there, unsmoothed: the kernels see a line's end up to sigma beyond it.
bool is_lit(const Trial& t, const LineRange& r, std::size_t i) {
  return t.contrast(r, i) >= 2.5 * kTopNoise * t.profile_noise && t.w.colour[i] != LaserPlace::kNone;
}

/// Cuts unlit and bridged points off both ends. A lit end has half the contrast of the line a little further
/// in: what is darker was only blurred over the end.
LineRange trimmed(const Trial& t, const LineSet& lines, LineRange r) {
  const auto inside = static_cast<std::size_t>(std::lround(2.0 * t.kernels.sigma)) + 1;
  const auto bad = [&](std::size_t i, std::size_t further_in) {
    return (lines.points[i].flags & kStripeBridged) != 0 || !is_lit(t, r, i) ||
           t.contrast(r, i) < 0.5 * t.contrast(r, further_in);
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
  return median_of(t.w.scratch);
}

/// Replaces the points between two by a cubic that continues both sides; false where they do not fit.
bool bridge_stretch(std::vector<StripePoint>& points, std::size_t before, std::size_t after) {
  if (!can_bridge(points[before], points[after])) return false;
  for (std::size_t i = before + 1; i < after; ++i)
    points[i] = bridged_point(points[before], points[after],
                              static_cast<double>(i - before) / static_cast<double>(after - before));
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

/// Whether a stretch can be bad at all: medians lie within what they are medians of.
bool has_bad_point(const Trial& t, const LineSet& lines, const LineRange& r, double width) {
  const double lit = 2.5 * kTopNoise * t.profile_noise;
  for (std::size_t i = r.begin; i < r.end; ++i)
    if (lines.points[i].width > width || static_cast<double>(t.w.measure.contrast[i]) < lit ||
        t.w.colour[i] == LaserPlace::kNone)
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
      stretches.push_back({i, i, wide});
    stretches.back().last = i;
    stretches.back().spot = stretches.back().spot || wide;
  }
}

double stretch_width(Trial& t, const LineSet& lines, const BadStretch& bad) {
  return median_width(t, lines, {bad.first, bad.last + 1});
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
  const double width = median_width(t, lines, r);
  std::size_t begin = r.begin;
  for (const BadStretch& bad : t.w.stretches) {
    if (!bad.spot && bad.last - bad.first < longest) {
      // Dark, but the kernels followed a ridge there: it stays as a bridge.
      for (std::size_t k = bad.first; k <= bad.last; ++k) lines.points[k].flags |= kStripeBridged;
      continue;
    }
    const std::size_t grown = bad.spot ? margin + 1 : 1;
    const std::size_t before = bad.first > begin + grown ? bad.first - grown : begin;
    const std::size_t after = std::min(bad.last + grown, r.end);
    // A short rest behind a spot is the spot's own tip.
    const bool inside = before >= begin + least_run && after + least_run <= r.end;
    if (inside && bad.last - bad.first < longest && bridge_stretch(lines.points, before, after)) continue;
    // Bloom widens the line, but it goes on inside.
    if (bad.spot && stretch_width(t, lines, bad) < 2 * t.options.spot_width_ratio * width) continue;
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
  const auto upper = t.w.scratch.begin() + static_cast<std::ptrdiff_t>(t.w.scratch.size() * 3 / 4);
  std::nth_element(t.w.scratch.begin(), upper, t.w.scratch.end());
  return *upper;
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
  return t.w.scratch.empty() ? 1.0 : median_of(t.w.scratch);
}

LineFacts facts_of(Trial& t, const LineSet& lines, const LineRange& r) {
  constexpr std::size_t kChord = 4;  // points; shorter chords would add up the noise as well
  LineFacts facts;
  for (std::size_t i = r.begin; i + 1 < r.end; i += kChord) {
    const StripePoint &p = lines.points[i], &next = lines.points[std::min(i + kChord, r.end - 1)];
    const double dx = next.x - p.x, dy = next.y - p.y;
    facts.length += std::sqrt(dx * dx + dy * dy);
  }
  std::size_t bridged = 0, odd = 0, coloured = 0;
  for (std::size_t i = r.begin; i < r.end; ++i) {
    const StripePoint& p = lines.points[i];
    bridged += (p.flags & kStripeBridged) != 0 ? 1U : 0U;
    odd += (p.flags & (kStripeBridged | kStripeAsymmetric)) != 0 ? 1U : 0U;
    coloured += t.w.colour[i] != LaserPlace::kNone ? 1U : 0U;
    facts.mean_strength += p.strength;
  }
  const auto count = static_cast<double>(r.size());
  facts.mean_strength /= count;
  facts.bridged_share = static_cast<double>(bridged) / count;
  facts.odd_share = static_cast<double>(odd) / count;
  facts.coloured_share = static_cast<double>(coloured) / count;
  facts.colour_known = t.colour_known;
  facts.flanks = flank_ratio(t, lines, r);
  facts.width = median_width(t, lines, r);
  facts.intensity = typical_intensity(t, lines, r);
  return facts;
}

/// Length and width tests, which need no other line; a short line has to be the more regular.
bool is_stripe_like(const Trial& t, const LineFacts& line) {
  // Lines of their own scale are judged by length and brightness together, later on.
  const double least = t.width_slack > 1 && line.colour_known ? kShortest : 1.0;
  if (line.length < least * t.options.min_length * t.full_width || line.bridged_share > 0.5) return false;
  if (line.flanks < kLeastFlanks || line.coloured_share < 0.5) return false;
  const double ratio = std::max(line.width, 1e-3) / t.full_width;
  const double most =
      line.length < 12 * t.full_width ? 0.75 * t.options.max_width_ratio : t.options.max_width_ratio;
  return ratio < t.width_slack * most && 1.0 / ratio < 1.5 * t.width_slack * most;
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

/// What a strong stripe of this image looks like.
struct Reference {
  double intensity = 0;  ///< of the brightest line, short ones counting less
  double width = 0;      ///< px, of the lines at least half as bright
};

/// Median of the widths of the lines that are at least so bright, weighted by their length; px.
double commonest_width(std::span<const FilteredLines> groups, double least_intensity) {
  std::array<double, 64> lengths{};  // by the width in eighths of an octave
  double total = 0;
  for (const FilteredLines& group : groups)
    for (const LineFacts& line : *group.facts) {
      if (line.intensity < least_intensity) continue;
      const double index = std::clamp(8 * std::log2(std::max(line.width, 1.0)), 0.0, 63.0);
      lengths[static_cast<std::size_t>(index)] += line.length;
      total += line.length;
    }
  double below = 0;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    below += lengths[i];
    if (total > 0 && below >= 0.5 * total) return std::exp2((static_cast<double>(i) + 0.5) / 8);
  }
  return 0;
}

Reference strong_stripe(std::span<const FilteredLines> groups, const LineFilterOptions& options) {
  Reference reference;
  for (const FilteredLines& group : groups) {
    const double full_length = 3 * options.min_length * full_width_of(group.kernels->sigma);
    for (const LineFacts& line : *group.facts)
      reference.intensity =
          std::max(reference.intensity, line.intensity * std::min(1.0, line.length / full_length));
  }
  reference.width = commonest_width(groups, 0.5 * reference.intensity);
  return reference;
}

/// How much speaks for a line: long, bright, with two even flanks, all of it in the laser's colour. Crumbs of
/// texture and edges lack a little of each. In stripe widths of a perfect line.
double evidence(const LineFacts& line, double widths, double share) {
  return widths * std::min(share, 1.0) * line.flanks * (1 - 0.5 * line.odd_share) * line.coloured_share *
         line.coloured_share;
}

/// Brightness against the strong lines: weak lines have to be regular and as wide as the strong ones.
bool is_bright_enough(const DerivativeKernels& kernels, double noise, const LineFilterOptions& options,
                      double width_slack, const LineFacts& line, const Reference& reference) {
  const double share = line.intensity / reference.intensity;
  // Single pixels of a wide stripe may drown in noise that its ridge stands out of.
  const double visible = options.min_contrast_to_noise * noise / std::max(1.0, kernels.sigma);
  const double strength_noise = noise * kernels.curvature_gain;
  if (line.intensity < visible || line.mean_strength < 5 * strength_noise || share < options.min_contrast)
    return false;
  const double full_width = std::max(full_width_of(kernels.sigma), 0.8 * reference.width);
  const double widths = line.length / full_width;
  if (width_slack > 1 && evidence(line, widths, share) <
                             (line.colour_known ? kColouredEvidence : kGreyEvidence) * options.min_length)
    return false;
  if (share > options.clear_contrast) return true;
  // Mirror images and gleams are about as faint as this, but seldom as long and as even as the laser's line.
  constexpr double kFaint = 0.15, kEvenFlanks = 0.5;
  if (share < kFaint && (line.length < 3 * options.min_length * full_width || line.flanks < kEvenFlanks ||
                         line.odd_share > std::min(0.005 * widths, 0.4) || line.coloured_share < 0.8))
    return false;
  // The weaker, the longer: dim edges are short.
  if (line.length * share < options.clear_contrast * options.min_length * full_width) return false;
  const double ratio = line.width / reference.width;
  // Bridges and uneven flanks are rare on a stripe, frequent on stains and edges.
  const double most_odd = std::min(0.2 + 0.03 * std::max(0.0, widths - options.min_length), 0.5);
  const bool usual_width = width_slack > 1 || (ratio > 0.65 && ratio < 1.5);
  return line.odd_share < most_odd && usual_width;
}

/// Removes the lines (and their facts) that fail.
template <class Test>
void keep_if(LineSet& lines, std::vector<LineFacts>& facts, const Test& test) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < lines.lines.size(); ++k) {
    if (!test(facts[k])) continue;
    lines.lines[kept] = lines.lines[k];
    facts[kept++] = facts[k];
  }
  lines.lines.resize(kept);
  facts.resize(kept);
}

template <class T>
void look_at_colours(ImageView<T> image, const LineSet& lines, std::vector<std::uint8_t>& colour) {
  colour.assign(lines.points.size(), LaserPlace::kSure);
  if (image.where == nullptr) return;
  for (std::size_t i = 0; i < colour.size(); ++i) {
    const StripePoint& p = lines.points[i];
    const int x = std::clamp(static_cast<int>(p.x + 0.5), 0, image.width - 1),
              y = std::clamp(static_cast<int>(p.y + 0.5), 0, image.height - 1);
    colour[i] = image.laser_colour(x, y);
  }
}

}  // namespace

template <class T>
void filter_lines(ImageView<T> image, const DerivativeKernels& kernels, double noise,
                  const LineFilterOptions& options, double width_slack, LineFilterWorkspace& workspace,
                  LineSet& lines, std::vector<LineFacts>& facts) {
  Trial trial{
      kernels, noise, options, workspace, full_width_of(kernels.sigma), width_slack, image.where != nullptr};
  measure_points(image, kernels, noise, lines, workspace.measure);
  look_at_colours(image, lines, workspace.colour);
  workspace.kept.clear();
  for (std::size_t k = 0; k < lines.lines.size(); ++k) {
    trial.profile_noise = noise / std::sqrt(workspace.measure.averaged[k]);
    mend_or_cut(trial, lines, lines.lines[k]);
  }
  std::swap(lines.lines, workspace.kept);
  facts.clear();
  for (const LineRange& r : lines.lines) {
    LineFacts& line = facts.emplace_back(facts_of(trial, lines, r));
    if (width_slack > 1 && is_hot_column(lines, r, line)) line.length = 0;
    if (line.flanks >= kLeastFlanks) continue;
    workspace.edges.length += line.length;
    workspace.edges.weighted_height += 2 * line.intensity * line.length;
  }
  keep_if(lines, facts, [&](const LineFacts& line) { return is_stripe_like(trial, line); });
}

void drop_faint_lines(std::span<const FilteredLines> groups, double noise, const LineFilterOptions& options,
                      double width_slack, double least_height, const EdgeCrowd& edges) {
  Reference reference = strong_stripe(groups, options);
  reference.intensity = std::max(reference.intensity, least_height);
  double kept = 0;
  for (const FilteredLines& group : groups)
    for (const LineFacts& line : *group.facts) kept += line.length;
  // In a grey picture full of edges a line no brighter than they are is made by the same things.
  const double least_intensity =
      width_slack > 1 && edges.length > kManyEdges * kept ? kOverEdges * edges.height() : 0.0;
  for (const FilteredLines& group : groups)
    keep_if(*group.lines, *group.facts, [&](const LineFacts& line) {
      return (line.colour_known || line.intensity > least_intensity) &&
             is_bright_enough(*group.kernels, noise, options, width_slack, line, reference);
    });
}

template void filter_lines<std::uint8_t>(ImageView8, const DerivativeKernels&, double,
                                         const LineFilterOptions&, double, LineFilterWorkspace&, LineSet&,
                                         std::vector<LineFacts>&);
template void filter_lines<std::uint16_t>(ImageView16, const DerivativeKernels&, double,
                                          const LineFilterOptions&, double, LineFilterWorkspace&, LineSet&,
                                          std::vector<LineFacts>&);

}  // namespace lightstripe
