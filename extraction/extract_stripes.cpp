// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/extract_stripes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "extraction/compare/grey_value_lines.h"
#include "extraction/compare/hu_recursive.h"
#include "extraction/compare/steger.h"
#include "extraction/compare/zhou_roi.h"
#include "extraction/finish_lines.h"
#include "extraction/hand_over.h"
#include "extraction/image/binned_image.h"
#include "extraction/image/image_facts.h"
#include "extraction/image/negative.h"
#include "extraction/image/stripe_width.h"
#include "extraction/kernels/width_rule.h"
#include "extraction/lines/line_set.h"
#include "extraction/lines/ranked_value.h"
#include "extraction/parsed_options.h"
#include "extraction/track/track_stripes.h"
#include "extraction/workspace.h"

namespace lightstripe {
namespace {

/// One extraction: what is given, what is known of the image, and where the work goes on.
template <class T>
struct Run {
  ImageView<T> image;
  const ExtractionOptions& options;
  const ParsedOptions& parsed;
  ImageFacts facts;
  ExtractionWorkspace& w;
  ExtractionResult& result;
  const WindowedSearch* windowed = nullptr;  ///< null: the whole image
};

double sigma_of_width(double full_width) {
  return std::clamp(sigma_of_full_width(full_width), kLeastSigma, kLargestSigma);
}

template <class T>
std::optional<double> choose_sigma(const Run<T>& run) {
  if (run.options.sigma) return *run.options.sigma;
  if (run.options.stripe_width) return sigma_of_width(*run.options.stripe_width);
  const int block = seed_block(run.facts);
  const double contrast = seed_contrast(run.facts.noise, block);
  if (block == 1) {
    const auto width = estimate_stripe_width(run.image, run.result.threshold_low, contrast);
    return width ? std::optional(sigma_of_width(*width)) : std::nullopt;
  }
  Image<T>& binned = run.w.template direction_guided<T>().binned;
  bin_image(run.image, block, binned);
  const auto width = estimate_stripe_width(binned.view(), 0, contrast);
  return width ? std::optional(sigma_of_width(*width * block)) : std::nullopt;
}

/// Where following begins and when it may stop; in the region's pixels.
template <class T>
FollowRule follow_rule(const Run<T>& run) {
  FollowRule rule;
  rule.brightest = run.facts.histogram.largest;
  rule.stop_after = run.options.stop_after;
  rule.least_length = run.options.lines.min_length * full_width_of(run.result.sigma);
  if (!run.parsed.start) return rule;
  rule.has_start = true;
  rule.start_x = run.parsed.start->x - (run.parsed.roi ? run.parsed.roi->x : 0);
  rule.start_y = run.parsed.start->y - (run.parsed.roi ? run.parsed.roi->y : 0);
  return rule;
}

/// Nobody said how wide the stripes are, and the method can tell line by line.
bool scales_are_free(const ExtractionOptions& options, const ParsedOptions& parsed) {
  return !options.sigma && !options.stripe_width && !parsed.start &&
         options.method == ExtractionMethod::kDirectionGuided;
}

/// Measures and judges the lines of all scales.
template <class T>
void filter_groups(const Run<T>& run, double width_slack) {
  ExtractionWorkspace& w = run.w;
  w.facts.resize(std::max(w.facts.size(), w.groups.count));
  w.filtered.clear();
  w.tests.edges = {};
  w.tests.tried = w.groups.rejected;
  const double brightest = run.facts.histogram.largest;
  const LineFilterRule rule{run.facts.noise.seen, brightest, width_slack};
  for (std::size_t g = 0; g < w.groups.count; ++g) {
    ScaleGroup& group = w.groups.all[g];
    filter_lines(run.image, *group.kernels, rule, run.options.lines, w.tests, group.lines, w.facts[g]);
    w.filtered.push_back({group.kernels, &group.lines, &w.facts[g]});
  }
  // Gleams with the laser off; a faint line has to be long. The range of 16-bit pixels is not known.
  const double least_height = width_slack > 1 && sizeof(T) == 1 ? 20.0 : 0.0;
  // Of video's range, tone curves and 16 bits it is not known where the camera clips. Dark lines may be flat.
  constexpr double kNearTop = 0.9;
  const bool bright = run.options.polarity == Polarity::kBright;
  const double range_end = bright ? kNearTop * brightest : 0.0;
  // Who gives a width or a board says that a line is there.
  const bool doubtful =
      scales_are_free(run.options, run.parsed) && !run.options.on_pattern && sizeof(T) == 1 && bright;
  const double extent = doubtful ? 1.0 * (run.image.width + run.image.height) : 0.0;
  drop_faint_lines(w.filtered, run.options.lines,
                   {run.facts.noise.seen, width_slack, least_height, range_end, extent}, w.tests.edges);
}

/// The foot of a glowing stripe is up to twice as wide as the core that chose the scale, and a width that a
/// person gives is a guess.
constexpr double kWidthSlack = 2;

/// All lines at the one scale `result.sigma`.
template <class T>
void find_lines(const Run<T>& run) {
  ExtractionWorkspace& w = run.w;
  if (w.kernels.sigma != run.result.sigma) w.kernels = make_derivative_kernels(run.result.sigma);
  const RidgeLimits limits = ridge_limits(w.kernels, run.facts, run.parsed, run.result);
  w.groups.count = w.groups.rejected = 0;
  LineSet& lines = w.groups.add(w.kernels).lines;
  switch (run.options.method) {
    case ExtractionMethod::kDirectionGuided:
      follow_lines(run.image, w.kernels, limits, follow_rule(run), w.direction_guided<T>(), lines);
      break;
    case ExtractionMethod::kSteger:
      find_lines_steger(run.image, w.kernels, limits, w.whole_image, lines);
      break;
    case ExtractionMethod::kZhouRoi:
      find_lines_zhou(run.image, w.kernels, limits, run.result.levels.t_otsu, w.whole_image, lines);
      break;
    case ExtractionMethod::kHuRecursive:
      find_lines_hu(run.image, w.kernels, limits, w.whole_image, lines);
      break;
    case ExtractionMethod::kCentroid:
      find_lines_by_grey_value(run.image, w.kernels, limits, GreyValueCentre::kCentroid, w.grey_values,
                               lines);
      break;
    case ExtractionMethod::kExtremum:
      find_lines_by_grey_value(run.image, w.kernels, limits, GreyValueCentre::kExtremum, w.grey_values,
                               lines);
      break;
  }
  filter_groups(run, run.options.method == ExtractionMethod::kDirectionGuided ? kWidthSlack : 1.0);
}

/// Each line at its own scale; `result.sigma` becomes that of the longest one.
template <class T>
void find_lines_at_own_scale(const Run<T>& run) {
  ExtractionWorkspace& w = run.w;
  FollowTuning tuning;
  if (run.options.on_pattern) tuning.main_grain = std::numeric_limits<double>::infinity();
  const OwnScaleSearch<T> search{run.image,
                                 run.facts.noise.seen,
                                 run.facts.histogram.largest,
                                 run.options.lines.min_length,
                                 run.options.stop_after,
                                 tuning,
                                 run.windowed};
  const LimitsMaker limits{&run, [](const void* given, const DerivativeKernels& kernels, double noise) {
                             const auto& r = *static_cast<const Run<T>*>(given);
                             ImageFacts facts = r.facts;
                             facts.noise.seen = noise;
                             return ridge_limits(kernels, facts, r.parsed, r.result);
                           }};
  follow_lines_at_own_scale(search, limits, w.kernel_cache, w.direction_guided<T>(), w.own_scale<T>(),
                            w.groups);
  filter_groups(run, kWidthSlack);
  std::size_t longest = 0;
  for (const ScaleGroup& group : w.groups.used())
    for (const LineRange& r : group.lines.lines) {
      if (r.size() <= longest) continue;
      longest = r.size();
      run.result.sigma = group.kernels->sigma;
    }
}

/// Median width of the brighter measured points; nothing without points.
std::optional<double> found_width(ExtractionWorkspace& w) {
  const LineSet& lines = w.groups.all[0].lines;
  float brightest = 0;
  for (const LineRange& r : lines.lines)
    for (std::size_t i = r.begin; i < r.end; ++i) brightest = std::max(brightest, lines.points[i].intensity);
  w.values.clear();
  for (const LineRange& r : lines.lines)
    for (std::size_t i = r.begin; i < r.end; ++i) {
      const StripePoint& p = lines.points[i];
      if (p.flags == 0 && p.intensity > 0.3F * brightest) w.values.push_back(static_cast<float>(p.width));
    }
  if (w.values.empty()) return std::nullopt;
  return ranked_median(w.values);
}

std::size_t measured_points(const ExtractionWorkspace& w) {
  const LineSet& lines = w.groups.all[0].lines;
  std::size_t count = 0;
  for (const LineRange& r : lines.lines)
    for (std::size_t i = r.begin; i < r.end; ++i) count += lines.points[i].flags == 0 ? 1U : 0U;
  return count;
}

/// The estimated width came from single pixels; whole lines know better. The scale follows the lines' own
/// width, as long as that does not lose points.
template <class T>
void refine_sigma(const Run<T>& run) {
  for (int pass = 0; pass < 3; ++pass) {
    const auto width = found_width(run.w);
    if (!width) return;
    const double before = run.result.sigma;
    const double change = std::clamp(sigma_of_width(*width) / before, 0.7, 1.4);
    if (std::abs(std::log(change)) < 0.15) return;
    const std::size_t points = measured_points(run.w);
    run.result.sigma = std::clamp(change * before, kLeastSigma, kLargestSigma);
    find_lines(run);
    if (20 * measured_points(run.w) >= 19 * points) continue;
    run.result.sigma = before;
    find_lines(run);
    return;
  }
}

/// The part of the image that is looked at, and where it begins.
template <class T>
ImageView<T> region_of(ImageView<T> image, const ParsedOptions& parsed) {
  if (!parsed.roi) return image;
  const PixelRectangle& r = *parsed.roi;
  const int width = std::min(r.width, image.width - r.x), height = std::min(r.height, image.height - r.y);
  return width > 0 && height > 0 ? image.crop(r.x, r.y, width, height) : ImageView<T>{};
}

void begin(ExtractionWorkspace& w, ExtractionResult& result) {
  result.sigma = result.threshold_low = result.threshold_high = result.noise = 0;
  result.levels = {};
  result.impression = Impression::kNone;
  w.tests.edges = {};
  w.tests.tried = 0;
  w.groups.count = w.groups.rejected = 0;
}

/// From the facts to the finished lines.
template <class T>
void search(const Run<T>& run) {
  run.result.noise = run.facts.noise.full;
  choose_levels(run.facts, run.options, run.parsed, run.result);
  if (scales_are_free(run.options, run.parsed)) {
    find_lines_at_own_scale(run);
  } else if (const auto sigma = choose_sigma(run)) {
    run.result.sigma = *sigma;
    find_lines(run);
    if (!run.options.sigma && !run.options.stripe_width) refine_sigma(run);
  }
  finish_lines(run.image, run.options, run.facts.noise.full, run.w);
}

template <class T>
void extract(ImageView<T> whole, const ExtractionOptions& options, const ParsedOptions& parsed,
             ExtractionWorkspace& w, ExtractionResult& result) {
  if (options.polarity == Polarity::kDark && !whole.empty())
    whole = inverted(whole, w.template negative<T>());
  begin(w, result);
  const ImageView<T> image = region_of(whole, parsed);
  const PixelPlace origin{parsed.roi ? 1.0 * parsed.roi->x : 0.0, parsed.roi ? 1.0 * parsed.roi->y : 0.0};
  if (image.empty()) return hand_over(w, options.max_lines, origin, result);
  const Run<T> run{image, options, parsed, look_at(image), w, result, nullptr};
  search(run);
  hand_over(w, options.max_lines, origin, result);
  if (result.stripes.empty())
    result.impression = impression_of(
        run.facts.histogram, {run.facts.noise.seen, full_scale_of(image, run.facts.histogram.largest),
                              w.tests.tried, w.tests.edges.length});
}

/// Where a scale is given, the full search costs no more than windows do.
bool can_track(const ExtractionOptions& options, const ParsedOptions& parsed) {
  return scales_are_free(options, parsed) && !parsed.roi && options.stop_after == 0 &&
         options.polarity == Polarity::kBright;
}

/// The search in windows; false where the result cannot be that of the full search.
template <class T>
bool extract_in_windows(ImageView<T> image, const ExtractionOptions& options, const ParsedOptions& parsed,
                        const TrackReference& before, ExtractionWorkspace& w, ExtractionResult& result) {
  const auto facts =
      look_through(image, before, options.lines.min_length * full_width_of(before.sigma), w.track);
  if (!facts || seed_block(*facts) > 1) return false;
  const WindowedSearch windowed{&w.track.windows, &w.track.seen, noise_of_levels(before, facts->noise.seen),
                                coarsest_level(before)};
  begin(w, result);
  search(Run<T>{image, options, parsed, *facts, w, result, &windowed});
  hand_over(w, 0, {}, result);
  if (!has_all_lines(before, result.stripes, w.track)) return false;
  if (options.max_lines > 0 && result.stripes.size() > static_cast<std::size_t>(options.max_lines))
    resize_stripes(static_cast<std::size_t>(options.max_lines), w, result.stripes);
  return true;
}

template <class T>
bool track(ImageView<T> image, const ExtractionOptions& options, const TrackReference& before,
           ExtractionWorkspace& w, ExtractionResult& result) {
  const ParsedOptions parsed = parse_options(options);
  const bool tracked = !before.empty() && before.width == image.width && before.height == image.height &&
                       can_track(options, parsed) &&
                       extract_in_windows(image, options, parsed, before, w, result);
  if (!tracked) extract(image, options, parsed, w, result);
  return tracked;
}

}  // namespace

void extract_stripes(ImageView8 image, const ExtractionOptions& options, ExtractionWorkspace& workspace,
                     ExtractionResult& result) {
  extract(image, options, parse_options(options), workspace, result);
}

void extract_stripes(ImageView16 image, const ExtractionOptions& options, ExtractionWorkspace& workspace,
                     ExtractionResult& result) {
  extract(image, options, parse_options(options), workspace, result);
}

ExtractionResult extract_stripes(ImageView8 image, const ExtractionOptions& options) {
  ExtractionWorkspace workspace;
  ExtractionResult result;
  extract(image, options, parse_options(options), workspace, result);
  return result;
}

ExtractionResult extract_stripes(ImageView16 image, const ExtractionOptions& options) {
  ExtractionWorkspace workspace;
  ExtractionResult result;
  extract(image, options, parse_options(options), workspace, result);
  return result;
}

bool track_stripes(ImageView8 image, const ExtractionOptions& options, const TrackReference& before,
                   ExtractionWorkspace& workspace, ExtractionResult& result) {
  return track(image, options, before, workspace, result);
}

bool track_stripes(ImageView16 image, const ExtractionOptions& options, const TrackReference& before,
                   ExtractionWorkspace& workspace, ExtractionResult& result) {
  return track(image, options, before, workspace, result);
}

}  // namespace lightstripe
