// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/image/image_facts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lightstripe {

int facts_thinning(int width, int height) {
  constexpr double kEnoughPixels = 16000;
  return std::max(1, static_cast<int>(static_cast<double>(width) * height / kEnoughPixels));
}

template <class T>
NoiseEstimate noise_of(ImageView<T> image) {
  const int thinning = facts_thinning(image.width, image.height);
  return estimate_noise(image, thinning > 1 ? 4 * thinning : 1);
}

template <class T>
ImageFacts look_at(ImageView<T> image) {
  ImageFacts facts;
  facts.histogram = compute_histogram(image, facts_thinning(image.width, image.height));
  facts.noise = noise_of(image);
  return facts;
}

template NoiseEstimate noise_of<std::uint8_t>(ImageView8);
template NoiseEstimate noise_of<std::uint16_t>(ImageView16);

template ImageFacts look_at<std::uint8_t>(ImageView8);
template ImageFacts look_at<std::uint16_t>(ImageView16);

void choose_levels(const ImageFacts& facts, const ExtractionOptions& options, const ParsedOptions& parsed,
                   ExtractionResult& result) {
  ThresholdOptions threshold_options;
  threshold_options.alpha = options.alpha;
  threshold_options.beta = options.beta;
  result.levels = compute_bilevel_thresholds(facts.histogram, threshold_options);
  switch (parsed.rule) {
    case ThresholdRule::kBilevel:
      result.threshold_low = result.levels.low;
      result.threshold_high = result.levels.high;
      break;
    case ThresholdRule::kOtsu:
      result.threshold_low = result.threshold_high = result.levels.t_otsu;
      break;
    case ThresholdRule::kRosin:
      result.threshold_low = result.threshold_high = result.levels.t_rosin;
      break;
    case ThresholdRule::kGiven:
      result.threshold_low = parsed.given.low;
      result.threshold_high = parsed.given.high;
      break;
  }
}

double seed_contrast(const NoiseEstimate& noise, int block) {
  return std::max(4.0 / block, 5.0 * noise.seen / block);
}

int seed_block(const ImageFacts& facts) {
  // A stripe at the sensor's full range has to stand well above what the noise alone may do.
  const double range = facts.histogram.largest;
  if (5.0 * facts.noise.seen < 0.3 * range) return 1;
  return 5.0 * facts.noise.seen < 0.6 * range ? 2 : 4;
}

RidgeLimits ridge_limits(const DerivativeKernels& kernels, const ImageFacts& facts,
                         const ParsedOptions& parsed, const ExtractionResult& result) {
  const double strength_noise = facts.noise.seen * kernels.curvature_gain;
  RidgeLimits limits;
  limits.level_low = result.threshold_low;
  limits.level_high = result.threshold_high;
  limits.hard_levels = parsed.rule != ThresholdRule::kBilevel;
  limits.seed_block = seed_block(facts);
  limits.start_contrast = seed_contrast(facts.noise, limits.seed_block);
  limits.start_strength = std::max(7.0 * strength_noise, 3.0 * kernels.matched_strength());
  limits.follow_strength = std::max(3.5 * strength_noise, 1.5 * kernels.matched_strength());
  limits.shaded_strength =
      limits.hard_levels ? std::numeric_limits<double>::infinity() : 1.4 * limits.follow_strength;
  limits.strength_noise = strength_noise;
  limits.clear_strength = 12.0 * strength_noise;
  limits.largest_gap = 2 + static_cast<int>(std::lround(3.0 * kernels.sigma));
  return limits;
}

}  // namespace lightstripe
