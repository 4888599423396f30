// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/extract_stripes.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>

#include "core/error.h"
#include "extraction/centroid.h"
#include "extraction/curvature_bias.h"
#include "extraction/line_measure.h"
#include "extraction/noise.h"
#include "extraction/steger.h"
#include "extraction/stripe_width.h"
#include "extraction/workspace.h"
#include "extraction/zhou_roi.h"

namespace lightstripe {
namespace {

constexpr double kLeastSigma = 0.7;  // px; below it the pixels no longer carry the derivatives
constexpr double kLargestSigma = 20;

struct LevelPair {
  double low = 0, high = 0;
};

/// "LOW,HIGH" in grey levels; nothing for "auto".
std::optional<LevelPair> given_levels(const std::string& text) {
  if (text == "auto") return std::nullopt;
  LevelPair pair;
  const char* end = text.data() + text.size();
  const auto [comma, error] = std::from_chars(text.data(), end, pair.low);
  const bool low_ok = error == std::errc{} && comma != end && *comma == ',';
  const auto rest = low_ok ? std::from_chars(comma + 1, end, pair.high) : std::from_chars_result{};
  if (!low_ok || rest.ec != std::errc{} || rest.ptr != end || !(pair.low >= 0) || !(pair.high >= pair.low))
    throw Error("thresholds", "'" + text + "' is not a pair of grey levels",
                "write auto, or LOW,HIGH with 0 <= LOW <= HIGH");
  return pair;
}

void require(bool ok, const char* option, double value, const char* rule) {
  if (!ok)
    throw Error(option, "the value " + std::to_string(value) + " is out of range",
                std::string("give ") + rule);
}

void check_options(const ExtractionOptions& o) {
  const double largest_width = 2 * std::numbers::sqrt3 * kLargestSigma;
  if (o.stripe_width)
    require(*o.stripe_width >= 1 && *o.stripe_width <= largest_width, "stripe_width", *o.stripe_width,
            "a full width of 1 to 69 px");
  if (o.sigma)
    require(*o.sigma >= kLeastSigma && *o.sigma <= kLargestSigma, "sigma", *o.sigma, "0.7 to 20 px");
  if (o.alpha) require(*o.alpha >= 0 && *o.alpha <= 1, "alpha", *o.alpha, "a weight of 0 to 1");
  require(o.beta >= 0 && o.beta <= 1, "beta", o.beta, "a weight of 0 to 1");
  require(o.max_lines >= 0, "max_lines", o.max_lines, "0 (all) or a number of lines");
  require(o.lines.min_length >= 0, "lines.min_length", o.lines.min_length, "0 or more stripe widths");
  require(o.lines.max_width_ratio > 1, "lines.max_width_ratio", o.lines.max_width_ratio, "a ratio above 1");
  require(o.lines.spot_width_ratio > 1, "lines.spot_width_ratio", o.lines.spot_width_ratio,
          "a ratio above 1");
}

double sigma_of_width(double full_width) {
  return std::clamp(full_width / (2 * std::numbers::sqrt3), kLeastSigma, kLargestSigma);
}

/// What the image as a whole says, before any line is looked for.
struct ImageFacts {
  Histogram histogram;
  double noise = 0;
  double seed_contrast = 0;  ///< grey levels: less than this over the surroundings is noise
};

/// Statistics need some 100 000 pixels, whatever the image's size; the brightest pixel is looked for in all.
template <class T>
ImageFacts look_at(ImageView<T> image) {
  constexpr double kEnoughPixels = 40000;
  const double pixels = static_cast<double>(image.width) * image.height;
  const int row_step =
      std::clamp(static_cast<int>(pixels / kEnoughPixels), 1, std::max(1, image.height / 32));
  ImageFacts facts;
  facts.histogram = compute_histogram(image, row_step);
  facts.noise = estimate_noise(image, 4 * row_step);
  facts.seed_contrast = std::max(4.0, 5.0 * facts.noise);
  return facts;
}

void choose_levels(const ImageFacts& facts, const ExtractionOptions& options, ExtractionResult& result) {
  if (const auto given = given_levels(options.thresholds)) {
    result.levels = {};
    result.threshold_low = given->low;
    result.threshold_high = given->high;
    return;
  }
  ThresholdOptions threshold_options;
  threshold_options.alpha = options.alpha;
  threshold_options.beta = options.beta;
  result.levels = compute_bilevel_thresholds(facts.histogram, threshold_options);
  result.threshold_low = result.levels.low;
  result.threshold_high = result.levels.high;
}

template <class T>
std::optional<double> choose_sigma(ImageView<T> image, const ExtractionOptions& options,
                                   const ImageFacts& facts, double level) {
  if (options.sigma) return *options.sigma;
  if (options.stripe_width) return sigma_of_width(*options.stripe_width);
  const auto width = estimate_stripe_width(image, level, facts.seed_contrast);
  if (!width) return std::nullopt;
  return sigma_of_width(*width);
}

RidgeLimits ridge_limits(const DerivativeKernels& kernels, const ImageFacts& facts,
                         const ExtractionOptions& options, const ExtractionResult& result) {
  const double strength_noise = facts.noise * kernels.curvature_gain;
  RidgeLimits limits;
  limits.level_low = result.threshold_low;
  limits.level_high = result.threshold_high;
  limits.hard_levels = options.thresholds != "auto";
  limits.start_contrast = facts.seed_contrast;
  limits.start_strength = std::max(7.0 * strength_noise, 3.0 * kernels.matched_strength());
  limits.follow_strength = std::max(3.5 * strength_noise, 1.5 * kernels.matched_strength());
  limits.shaded_strength =
      limits.hard_levels ? std::numeric_limits<double>::infinity() : 1.4 * limits.follow_strength;
  limits.strength_noise = strength_noise;
  limits.clear_strength = 12.0 * strength_noise;
  limits.largest_gap = 2 + static_cast<int>(std::lround(3.0 * kernels.sigma));
  return limits;
}

template <class T>
void find_lines(ImageView<T> image, const ExtractionOptions& options, const ImageFacts& facts,
                ExtractionWorkspace& w, ExtractionResult& result) {
  if (w.kernels.sigma != result.sigma) w.kernels = make_derivative_kernels(result.sigma);
  const RidgeLimits limits = ridge_limits(w.kernels, facts, options, result);
  w.lines.clear();
  switch (options.method) {
    case ExtractionMethod::kDirectionGuided:
      follow_lines(image, w.kernels, limits, facts.histogram.largest, w.direction_guided<T>(), w.lines);
      break;
    case ExtractionMethod::kSteger:
      find_lines_steger(image, w.kernels, limits, w.lines);
      break;
    case ExtractionMethod::kZhouRoi:
      find_lines_zhou(image, w.kernels, limits, result.levels.t_otsu, w.lines);
      break;
    case ExtractionMethod::kCentroid:
      find_lines_centroid(image, w.kernels, limits, w.lines);
      break;
  }
  test_lines(image, w.kernels, facts.noise, options.lines, w.tests, w.lines);
}

/// Median width of the brighter measured points; nothing without points.
std::optional<double> found_width(ExtractionWorkspace& w) {
  float brightest = 0;
  for (const StripePoint& p : w.lines.points) brightest = std::max(brightest, p.intensity);
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
void refine_sigma(ImageView<T> image, const ExtractionOptions& options, const ImageFacts& facts,
                  ExtractionWorkspace& w, ExtractionResult& result) {
  for (int pass = 0; pass < 3; ++pass) {
    const auto width = found_width(w);
    if (!width) return;
    const double before = result.sigma;
    const double change = std::clamp(sigma_of_width(*width) / before, 0.7, 1.4);
    if (std::abs(std::log(change)) < 0.15) return;
    const std::size_t points = measured_points(w);
    result.sigma = std::clamp(change * before, kLeastSigma, kLargestSigma);
    find_lines(image, options, facts, w, result);
    if (20 * measured_points(w) >= 19 * points) continue;
    result.sigma = before;
    find_lines(image, options, facts, w, result);
    return;
  }
}

/// Longest lines first, each with growing x or y; into the result's own memory.
void hand_over(ExtractionWorkspace& w, int max_lines, ExtractionResult& result) {
  auto& lines = w.lines.lines;
  std::stable_sort(lines.begin(), lines.end(),
                   [](const LineRange& a, const LineRange& b) { return a.size() > b.size(); });
  if (max_lines > 0 && lines.size() > static_cast<std::size_t>(max_lines))
    lines.resize(static_cast<std::size_t>(max_lines));
  result.stripes.resize(lines.size());
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const auto first = w.lines.points.begin() + static_cast<std::ptrdiff_t>(lines[k].begin);
    const auto last = w.lines.points.begin() + static_cast<std::ptrdiff_t>(lines[k].end);
    auto& points = result.stripes[k].points;
    points.assign(first, last);
    const double dx = points.back().x - points.front().x, dy = points.back().y - points.front().y;
    if ((std::abs(dx) >= std::abs(dy) ? dx : dy) >= 0) continue;
    std::reverse(points.begin(), points.end());
    for (StripePoint& p : points) {
      p.normal_x = -p.normal_x;
      p.normal_y = -p.normal_y;
    }
  }
}

template <class T>
void extract(ImageView<T> image, const ExtractionOptions& options, ExtractionWorkspace& w,
             ExtractionResult& result) {
  check_options(options);
  result.stripes.clear();
  result.sigma = result.threshold_low = result.threshold_high = result.noise = 0;
  result.levels = {};
  if (image.empty()) return;
  const ImageFacts facts = look_at(image);
  result.noise = facts.noise;
  choose_levels(facts, options, result);
  const auto sigma = choose_sigma(image, options, facts, result.threshold_low);
  if (!sigma) return;
  result.sigma = *sigma;
  find_lines(image, options, facts, w, result);
  if (!options.sigma && !options.stripe_width) refine_sigma(image, options, facts, w, result);
  smooth_measures(w.kernels, w.lines, w.scratch);
  predict_errors(w.kernels, facts.noise, w.lines);
  if (options.curvature_correction && options.method != ExtractionMethod::kCentroid)
    correct_curvature_bias(w.kernels, w.lines, w.scratch, w.values);
  hand_over(w, options.max_lines, result);
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
