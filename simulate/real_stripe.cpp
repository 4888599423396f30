// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "simulate/real_stripe.h"

#include <algorithm>

#include "core/random.h"

namespace lightstripe {
namespace {

/// The share of the peak's light `d` px right of the centre.
double light_across(const RealStripe& stripe, double d) {
  const double s = stripe.sigma;
  const auto gaussian = [s](double x) { return std::exp(-0.5 * x * x / (s * s)); };
  double light = gaussian(d);
  if (stripe.mirror > 0) light += stripe.mirror * gaussian(d - stripe.mirror_at);
  if (stripe.glow > 0) {
    // The tail begins at the centre and is drawn by the same optics: an exponential after a Gaussian.
    const double ratio = s / stripe.glow_reach;
    light += stripe.glow * 0.5 * std::exp(std::min(50.0, 0.5 * ratio * ratio - d / stripe.glow_reach)) *
             std::erfc((ratio - d / s) / std::sqrt(2.0));
  }
  return light;
}

}  // namespace

Image8 picture_of(const RealStripe& stripe, std::uint64_t seed) {
  Image<float> laser(stripe.width, stripe.height), total(stripe.width, stripe.height);
  for (int y = 0; y < stripe.height; ++y) {
    const double centre = stripe.centre(y), cosine = stripe.cosine(y);
    for (int x = 0; x < stripe.width; ++x) {
      const double d = (x - centre) * cosine;
      const double beyond = 0.5 * std::erfc(-(d - stripe.step_at) / 0.8 / std::sqrt(2.0));
      laser(x, y) = static_cast<float>(stripe.exposure * stripe.peak * light_across(stripe, d));
      total(x, y) = laser(x, y) + static_cast<float>(stripe.background + stripe.step * stripe.peak * beyond);
    }
  }
  add_speckle(laser, stripe.speckle, seed, 1, total);
  Image8 out(stripe.width, stripe.height);
  Random random(seed, 2);
  for (std::size_t i = 0; i < out.pixels.size(); ++i) {
    const double level = double{total.pixels[i]};
    const double noise =
        std::sqrt(stripe.read_noise * stripe.read_noise + stripe.shot_gain * std::max(level, 0.0));
    out.pixels[i] =
        static_cast<std::uint8_t>(std::clamp(std::lround(level + noise * random.gaussian()), 0L, 255L));
  }
  return out;
}

void add_to(RealScore& score, const RealStripe& truth, const std::vector<Stripe>& stripes) {
  std::vector<char> rows(static_cast<std::size_t>(truth.height), 0);
  const double reach = std::max(4.0, 1.5 * 3.46 * truth.sigma);
  score.lines += static_cast<double>(stripes.size());
  for (const Stripe& stripe : stripes)
    for (const StripePoint& p : stripe.points) {
      score.points += 1;
      const double error = (p.x - truth.centre(p.y)) * truth.cosine(p.y);
      if (std::abs(error) > reach) {
        score.false_points += 1;
        continue;
      }
      score.squares += error * error;
      score.predicted += p.sigma_px * p.sigma_px;
      score.surprise += error * error / (p.sigma_px * p.sigma_px);
      const long row = std::lround(p.y);
      if (row >= 0 && row < truth.height) rows[static_cast<std::size_t>(row)] = 1;
    }
  score.rows += truth.height;
  for (const char row : rows) score.found += row;
}

}  // namespace lightstripe
