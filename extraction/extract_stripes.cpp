// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/extract_stripes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "extraction/compare/grey_value_lines.h"
#include "extraction/compare/hu_recursive.h"
#include "extraction/compare/steger.h"
#include "extraction/compare/zhou_roi.h"
#include "extraction/image/binned_image.h"
#include "extraction/image/image_facts.h"
#include "extraction/image/stripe_width.h"
#include "extraction/lines/curvature_bias.h"
#include "extraction/lines/line_ends.h"
#include "extraction/lines/line_junctions.h"
#include "extraction/lines/line_measure.h"
#include "extraction/lines/line_noise.h"
#include "extraction/lines/smoothing.h"
#include "extraction/parsed_options.h"
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
};

double sigma_of_width(double full_width) {
  return std::clamp(full_width / (2 * std::numbers::sqrt3), kLeastSigma, kLargestSigma);
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
  rule.least_length = run.options.lines.min_length * 2 * std::numbers::sqrt3 * run.result.sigma;
  if (!run.parsed.start) return rule;
  rule.has_start = true;
  rule.start_x = run.parsed.start->x - (run.parsed.roi ? run.parsed.roi->x : 0);
  rule.start_y = run.parsed.start->y - (run.parsed.roi ? run.parsed.roi->y : 0);
  return rule;
}

template <class T>
void find_lines(const Run<T>& run) {
  ExtractionWorkspace& w = run.w;
  if (w.kernels.sigma != run.result.sigma) w.kernels = make_derivative_kernels(run.result.sigma);
  const RidgeLimits limits = ridge_limits(w.kernels, run.facts, run.parsed, run.result);
  w.lines.clear();
  switch (run.options.method) {
    case ExtractionMethod::kDirectionGuided:
      follow_lines(run.image, w.kernels, limits, follow_rule(run), w.direction_guided<T>(), w.lines);
      break;
    case ExtractionMethod::kSteger:
      find_lines_steger(run.image, w.kernels, limits, w.whole_image, w.lines);
      break;
    case ExtractionMethod::kZhouRoi:
      find_lines_zhou(run.image, w.kernels, limits, run.result.levels.t_otsu, w.whole_image, w.lines);
      break;
    case ExtractionMethod::kHuRecursive:
      find_lines_hu(run.image, w.kernels, limits, w.whole_image, w.lines);
      break;
    case ExtractionMethod::kCentroid:
      find_lines_by_grey_value(run.image, w.kernels, limits, GreyValueCentre::kCentroid, w.grey_values,
                               w.lines);
      break;
    case ExtractionMethod::kExtremum:
      find_lines_by_grey_value(run.image, w.kernels, limits, GreyValueCentre::kExtremum, w.grey_values,
                               w.lines);
      break;
  }
  filter_lines(run.image, w.kernels, run.facts.noise.seen, run.options.lines, w.tests, w.lines);
}

/// Median width of the brighter measured points; nothing without points.
std::optional<double> found_width(ExtractionWorkspace& w) {
  float brightest = 0;
  for (const LineRange& r : w.lines.lines)
    for (std::size_t i = r.begin; i < r.end; ++i)
      brightest = std::max(brightest, w.lines.points[i].intensity);
  w.values.clear();
  for (const LineRange& r : w.lines.lines)
    for (std::size_t i = r.begin; i < r.end; ++i) {
      const StripePoint& p = w.lines.points[i];
      if (p.flags == 0 && p.intensity > 0.3F * brightest) w.values.push_back(static_cast<float>(p.width));
    }
  if (w.values.empty()) return std::nullopt;
  return median_of(w.values);
}

std::size_t measured_points(const ExtractionWorkspace& w) {
  std::size_t count = 0;
  for (const LineRange& r : w.lines.lines)
    for (std::size_t i = r.begin; i < r.end; ++i) count += w.lines.points[i].flags == 0 ? 1U : 0U;
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

/// As many stripes as needed; the memory of points that are not needed now waits in the workspace.
void resize_stripes(std::size_t count, ExtractionWorkspace& w, std::vector<Stripe>& stripes) {
  for (; stripes.size() > count; stripes.pop_back()) w.spare.push_back(std::move(stripes.back()));
  for (; stripes.size() < count && !w.spare.empty(); w.spare.pop_back())
    stripes.push_back(std::move(w.spare.back()));
  stripes.resize(count);
}

/// Longest lines first, each with growing x or y; into the result's own memory.
void hand_over(ExtractionWorkspace& w, int max_lines, const PixelPlace& origin, ExtractionResult& result) {
  auto& lines = w.lines.lines;
  std::sort(lines.begin(), lines.end(), [](const LineRange& a, const LineRange& b) {
    return a.size() != b.size() ? a.size() > b.size() : a.begin < b.begin;
  });
  if (max_lines > 0 && lines.size() > static_cast<std::size_t>(max_lines))
    lines.resize(static_cast<std::size_t>(max_lines));
  resize_stripes(lines.size(), w, result.stripes);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const auto first = w.lines.points.begin() + static_cast<std::ptrdiff_t>(lines[k].begin);
    const auto last = w.lines.points.begin() + static_cast<std::ptrdiff_t>(lines[k].end);
    auto& points = result.stripes[k].points;
    points.assign(first, last);
    if (origin.x != 0 || origin.y != 0)
      for (StripePoint& p : points) {
        p.x += origin.x;
        p.y += origin.y;
      }
    const double dx = points.back().x - points.front().x, dy = points.back().y - points.front().y;
    if ((std::abs(dx) >= std::abs(dy) ? dx : dy) >= 0) continue;
    std::reverse(points.begin(), points.end());
    for (StripePoint& p : points) {
      p.normal_x = -p.normal_x;
      p.normal_y = -p.normal_y;
    }
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

bool has_ridges(ExtractionMethod method) {
  return method != ExtractionMethod::kCentroid && method != ExtractionMethod::kExtremum;
}

template <class T>
void finish_lines(const Run<T>& run) {
  ExtractionWorkspace& w = run.w;
  smooth_measures(w.kernels, w.lines, w.values);
  predict_errors(run.image, w.kernels, run.facts.noise.full, w.lines, w.errors);
  if (has_ridges(run.options.method)) {
    mend_line_ends(w.kernels, w.lines, w.bends.nodes);
    mend_junctions(w.kernels, w.lines);
  }
  if (run.options.curvature_correction && has_ridges(run.options.method))
    correct_curvature_bias(w.kernels, w.lines, w.bends);
  if (run.options.smoothing) smooth_along_lines(w.lines, w.smoothing);
  // Last: neither bends nor smoothing may take a bias for scatter.
  add_asymmetry(run.image, w.kernels, w.lines, w.asymmetry);
}

template <class T>
void extract(ImageView<T> whole, const ExtractionOptions& options, ExtractionWorkspace& w,
             ExtractionResult& result) {
  const ParsedOptions parsed = parse_options(options);
  result.sigma = result.threshold_low = result.threshold_high = result.noise = 0;
  result.levels = {};
  w.lines.clear();
  const ImageView<T> image = region_of(whole, parsed);
  const PixelPlace origin{parsed.roi ? 1.0 * parsed.roi->x : 0.0, parsed.roi ? 1.0 * parsed.roi->y : 0.0};
  if (!image.empty()) {
    const Run<T> run{image, options, parsed, look_at(image), w, result};
    result.noise = run.facts.noise.full;
    choose_levels(run.facts, options, parsed, result);
    if (const auto sigma = choose_sigma(run)) {
      result.sigma = *sigma;
      find_lines(run);
      if (!options.sigma && !options.stripe_width) refine_sigma(run);
      finish_lines(run);
    }
  }
  hand_over(w, options.max_lines, origin, result);
}

}  // namespace

void extract_stripes(ImageView8 image, const ExtractionOptions& options, ExtractionWorkspace& workspace,
                     ExtractionResult& result) {
  extract(image, options, workspace, result);
}

void extract_stripes(ImageView16 image, const ExtractionOptions& options, ExtractionWorkspace& workspace,
                     ExtractionResult& result) {
  extract(image, options, workspace, result);
}

ExtractionResult extract_stripes(ImageView8 image, const ExtractionOptions& options) {
  ExtractionWorkspace workspace;
  ExtractionResult result;
  extract(image, options, workspace, result);
  return result;
}

ExtractionResult extract_stripes(ImageView16 image, const ExtractionOptions& options) {
  ExtractionWorkspace workspace;
  ExtractionResult result;
  extract(image, options, workspace, result);
  return result;
}

}  // namespace lightstripe
