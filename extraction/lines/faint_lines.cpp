// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/faint_lines.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "extraction/kernels/width_rule.h"
#include "extraction/lines/laser_evidence.h"

namespace lightstripe {
namespace {

/// Of the mean height and of the mean brighter side of a crowd of edges, and how long they are together
/// against the lines to be a crowd.
constexpr double kOverEdges = 1.2, kOverBrightSides = 1.15, kManyEdges = 0.25;
/// The same share: a picture with as many edges shows lit things, and is not drawn.
constexpr double kSomeEdges = 0.05;
/// Times the least length: longer and more even lines are not made of edges by chance.
constexpr double kLongAndEven = 2.5;
/// Of the least length: evidence that a line needs, with and without the laser's colour.
constexpr double kColouredEvidence = 0.4, kGreyEvidence = 0.6;
/// Of the points of a line with even flanks; on bright lines of a picture less is rare.
constexpr double kEvenFlanks = 0.75;
/// Of the points of a line.
constexpr double kMostlyClipped = 0.5;
/// Of the least length, for a line that goes on where a kept one ends.
constexpr double kGoingOn = 0.4;

/// What a strong stripe of this image looks like.
struct Reference {
  double intensity = 0;  ///< of the brightest line, short ones counting less
  double rise = 0;       ///< the same of the laser's colour
  double width = 0;      ///< px, of the lines at least half as bright, with even flanks where there are any
};

/// Median of the widths of the lines that are at least so bright and even, weighted by their length; px. 0
/// where there are none.
double commonest_width(std::span<const FilteredLines> groups, double least_intensity, double least_flanks) {
  std::array<double, 64> lengths{};  // by the width in eighths of an octave
  double total = 0;
  for (const FilteredLines& group : groups)
    for (const LineFacts& line : *group.facts) {
      if (line.intensity < least_intensity || line.flanks < least_flanks) continue;
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
    for (const LineFacts& line : *group.facts) {
      const double counts = std::min(1.0, line.length / full_length);
      reference.intensity = std::max(reference.intensity, counts * line.intensity);
      if (line.colour.known) reference.rise = std::max(reference.rise, counts * line.colour.rise);
    }
  }
  reference.width = commonest_width(groups, 0.5 * reference.intensity, kEvenFlanks);
  if (reference.width == 0) reference.width = commonest_width(groups, 0.5 * reference.intensity, 0);
  return reference;
}

/// How much speaks for a line: long, bright, with two even flanks, all of it in the laser's colour. Crumbs of
/// texture and edges lack a little of each. In stripe widths of a perfect line.
double evidence(const LineFacts& line, double widths, double share) {
  return widths * std::min(share, 1.0) * line.flanks * (1 - 0.5 * line.odd_share) * line.coloured_share *
         line.coloured_share;
}

/// What the lines of one image are judged by.
struct Judge {
  const LineFilterOptions& options;
  const FaintLineRule& rule;
  Reference reference;
  /// Grey levels that lines in a grey picture full of edges have to exceed, in height or in level.
  double height_of_edges = 0, level_of_edges = 0;

  bool is_no_edge(const DerivativeKernels& kernels, const LineFacts& line) const;
  bool is_shading(const LineFacts& line, bool goes_on) const;
  bool is_visible(const DerivativeKernels& kernels, const LineFacts& line) const;
  bool is_bright_enough(const DerivativeKernels& kernels, const LineFacts& line, bool goes_on) const;
};

constexpr double kWide = 12;  // px

/// Light has a round top wherever the camera does not clip it, even far out of focus: a lens' disc of blur
/// gives a half ellipse (flatness 0.87). A bar with a flat one is printed, or a thing in other light.
bool is_flat_bar(const LineFacts& line, double range_end) {
  constexpr double kFlattest = 0.88, kClipped = 0.25;
  return line.flatness > kFlattest && line.clipped_share < kClipped && line.level < range_end;
}

/// In a picture full of edges a line no brighter than they are is made by the same things: printed bars are
/// as bright as the brighter side of the edges. Laser light adds to what it falls on.
bool Judge::is_no_edge(const DerivativeKernels& kernels, const LineFacts& line) const {
  if (line.colour_known || line.intensity > height_of_edges || line.level > level_of_edges) return true;
  return line.even_length() >= kLongAndEven * options.min_length * full_width_of(kernels.sigma);
}

/// Where no colour tells the laser: what is broader than this picture's lines and falls off unevenly is a
/// thing in other light; where nobody says that there is a line, also what is broad. Light out of focus is
/// broad, but even; a line that goes on may be uneven in its glow.
bool Judge::is_shading(const LineFacts& line, bool goes_on) const {
  constexpr double kBroader = 1.5, kMostOdd = 0.3;
  if (rule.width_slack <= 1 || line.colour_known || line.clipped_share >= kMostlyClipped) return false;
  const bool wide = rule.extent > 0 && line.width > kWide;
  if (line.flanks < kEvenFlanks) return wide || line.width > kBroader * reference.width;
  return wide && line.odd_share > kMostOdd && !goes_on;
}

bool Judge::is_visible(const DerivativeKernels& kernels, const LineFacts& line) const {
  // Single pixels of a wide stripe may drown in noise that its ridge stands out of.
  const double visible = options.min_contrast_to_noise * rule.noise / std::max(1.0, kernels.sigma);
  return line.intensity >= visible && line.mean_strength >= 5 * rule.noise * kernels.curvature_gain &&
         line.intensity >= options.min_contrast * reference.intensity;
}

/// Brightness against the strong lines: weak lines have to be regular and as wide as the strong ones.
/// `goes_on`: the line begins where one ends that is bright enough.
bool Judge::is_bright_enough(const DerivativeKernels& kernels, const LineFacts& line, bool goes_on) const {
  if (is_shading(line, goes_on)) return false;
  const double min_length = (goes_on ? kGoingOn : 1.0) * options.min_length;
  // What the camera clips in the laser's colour is as bright as a line can be, whatever glows beside it.
  const bool clipped_light = line.colour_known && line.clipped_share > kMostlyClipped;
  const double share = clipped_light ? 1.0 : line.intensity / reference.intensity;
  const double full_width = std::max(full_width_of(kernels.sigma), 0.8 * reference.width);
  const double widths = line.length / full_width;
  // A crumb as bright as the line, but less coloured, is no part of it.
  const double light = line.colour.known ? std::min(share, line.colour.rise / reference.rise) *
                                               std::min(1.0, line.colour.share / kUsualColour)
                                         : share;
  if (rule.width_slack > 1 &&
      evidence(line, widths, light) < (line.colour_known ? kColouredEvidence : kGreyEvidence) * min_length)
    return false;
  if (share > options.clear_contrast) return true;
  // Mirror images and gleams are about as faint as this, but seldom as long and as even as the laser's line.
  constexpr double kFaint = 0.15, kHalfEven = 0.5;
  if (share < kFaint &&
      (line.length < 3 * min_length * full_width || line.flanks < kHalfEven ||
       line.odd_share > std::min(goes_on ? 1.0 : 0.005 * widths, 0.4) || line.coloured_share < 0.8))
    return false;
  // The weaker, the longer: dim edges are short.
  if (line.length * share < options.clear_contrast * min_length * full_width) return false;
  const double ratio = line.width / reference.width;
  // Bridges and uneven flanks are rare on a stripe, frequent on stains and edges.
  const double most_odd = std::min(0.2 + 0.03 * std::max(0.0, widths - min_length), 0.5);
  const bool usual_width = rule.width_slack > 1 || (ratio > 0.65 && ratio < 1.5);
  return line.odd_share < most_odd && usual_width;
}

/// Where a line would go on beyond one of its ends.
struct Continuation {
  double x = 0, y = 0;              ///< px
  double along_x = 0, along_y = 0;  ///< unit, out of the line
};

Continuation continuation_of(const LineSet& lines, const LineRange& r, bool last, double width) {
  const std::size_t inside =
      std::min(r.size() - 1, static_cast<std::size_t>(std::lround(std::max(3.0, width))));
  const StripePoint &p = lines.points[last ? r.end - 1 : r.begin],
                    &q = lines.points[last ? r.end - 1 - inside : r.begin + inside];
  const double dx = p.x - q.x, dy = p.y - q.y, length = std::max(std::hypot(dx, dy), 1e-9);
  return {p.x, p.y, dx / length, dy / length};
}

/// Whether a line that begins at `b` may be the one that ends at `a`: straight on over a short gap, or, for
/// light of the laser's colour, around a corner close by. `width`: of the stripe, px.
bool goes_on(const Continuation& a, const Continuation& b, double width, bool coloured) {
  constexpr double kFarthest = 4, kCorner = 2, kAside = 0.75, kSpread = 0.2, kLeastCosine = 0.8;
  const double dx = b.x - a.x, dy = b.y - a.y, distance = std::hypot(dx, dy);
  if (coloured && distance < kCorner * width) return true;
  if (distance > kFarthest * width) return false;
  const double along = dx * a.along_x + dy * a.along_y, aside = std::abs(dx * a.along_y - dy * a.along_x);
  return along > -width && aside < kAside * width + kSpread * distance &&
         a.along_x * b.along_x + a.along_y * b.along_y < -kLeastCosine;
}

/// Whether a line's middle lies in a kept one, which broad kernels see once more.
bool lies_in_kept_line(std::span<const FilteredLines> groups, const StripePoint& middle, double width) {
  for (const FilteredLines& group : groups)
    for (std::size_t i = 0; i < group.facts->size(); ++i) {
      if (!(*group.facts)[i].kept) continue;
      const LineRange& r = group.lines->lines[i];
      const auto step = static_cast<std::size_t>(std::max(1.0, 0.5 * width));
      for (std::size_t k = r.begin; k < r.end; k += step) {
        const double dx = group.lines->points[k].x - middle.x, dy = group.lines->points[k].y - middle.y;
        if (dx * dx + dy * dy < width * width) return true;
      }
    }
  return false;
}

/// Whether one end of line `k` of a group lies where a kept line ends.
bool continues_kept_line(std::span<const FilteredLines> groups, const FilteredLines& group, std::size_t k) {
  const LineFacts& facts = (*group.facts)[k];
  const LineRange& range = group.lines->lines[k];
  if (lies_in_kept_line(groups, group.lines->points[range.begin + range.size() / 2], 0.5 * facts.width))
    return false;
  for (const FilteredLines& other : groups)
    for (std::size_t i = 0; i < other.facts->size(); ++i) {
      const LineFacts& kept = (*other.facts)[i];
      if (!kept.kept) continue;
      const double width = std::max({kept.width, facts.width, 3.0});
      for (const bool last : {false, true})
        for (const bool other_last : {false, true})
          if (goes_on(continuation_of(*other.lines, other.lines->lines[i], other_last, width),
                      continuation_of(*group.lines, group.lines->lines[k], last, width), width,
                      facts.colour.known))
            return true;
    }
  return false;
}

/// Keeps the lines that go on where kept ones end; true if there were any.
bool keep_continuations(std::span<const FilteredLines> groups, const Judge& judge) {
  bool found = false;
  for (const FilteredLines& group : groups)
    for (std::size_t k = 0; k < group.facts->size(); ++k) {
      LineFacts& line = (*group.facts)[k];
      if (line.kept || !judge.is_visible(*group.kernels, line) ||
          !judge.is_bright_enough(*group.kernels, line, true) || !continues_kept_line(groups, group, k))
        continue;
      line.kept = found = true;
    }
  return found;
}

double length_of(std::span<const FilteredLines> groups) {
  double length = 0;
  for (const FilteredLines& group : groups)
    for (const LineFacts& line : *group.facts) length += line.length;
  return length;
}

/// A narrow bar may be a drawn line, unless edges tell that things are lit. Returns what speaks for the
/// dropped ones.
double drop_flat_bars(std::span<const FilteredLines> groups, bool has_edges, double range_end) {
  double light = 0;
  for (const FilteredLines& group : groups) {
    for (LineFacts& line : *group.facts) {
      line.kept = !is_flat_bar(line, range_end) || (!has_edges && line.width < kWide);
      if (!line.kept) light += light_of_line(line);
    }
    drop_lines(*group.lines, *group.facts);
  }
  return light;
}

}  // namespace

void drop_faint_lines(std::span<const FilteredLines> groups, const LineFilterOptions& options,
                      const FaintLineRule& rule, const EdgeCrowd& edges) {
  const double length = length_of(groups);
  const bool full_of_edges = rule.width_slack > 1 && edges.length > kManyEdges * length;
  double bars = 0;
  if (rule.width_slack > 1) bars = drop_flat_bars(groups, edges.length > kSomeEdges * length, rule.range_end);
  Judge judge{options, rule, strong_stripe(groups, options)};
  judge.reference.intensity = std::max(judge.reference.intensity, rule.least_height);
  if (full_of_edges) {
    judge.height_of_edges = kOverEdges * edges.height();
    judge.level_of_edges = kOverBrightSides * edges.level();
  }
  for (const FilteredLines& group : groups)
    for (LineFacts& line : *group.facts)
      line.kept = judge.is_no_edge(*group.kernels, line) && judge.is_visible(*group.kernels, line) &&
                  judge.is_bright_enough(*group.kernels, line, false);
  while (rule.width_slack > 1 && keep_continuations(groups, judge)) {
  }
  if (rule.extent > 0 && !shows_laser(groups, edges, bars, rule.extent, options.min_length))
    for (const FilteredLines& group : groups)
      for (LineFacts& line : *group.facts) line.kept = false;
  for (const FilteredLines& group : groups) drop_lines(*group.lines, *group.facts);
}

}  // namespace lightstripe
