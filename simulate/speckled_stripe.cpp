// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "simulate/speckled_stripe.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"

namespace lightstripe {

double SpeckledStripe::centre(double y) { return 80 + 18 * std::sin(y / 80); }

double SpeckledStripe::cosine(double y) { return 1 / std::hypot(1, 18.0 / 80 * std::cos(y / 80)); }

Image8 render(const SpeckledStripe& stripe, std::uint64_t seed) {
  constexpr double kBackground = 8, kReadNoise = 1.5, kShotGain = 0.05;  // grey levels
  Image<float> laser(SpeckledStripe::kWidth, SpeckledStripe::kHeight), light = laser;
  for (int y = 0; y < laser.height; ++y)
    for (int x = 0; x < laser.width; ++x) {
      const double d = (x - SpeckledStripe::centre(y)) * SpeckledStripe::cosine(y) / stripe.sigma_px;
      laser(x, y) = static_cast<float>(stripe.peak * std::exp(-0.5 * d * d));
      light(x, y) = laser(x, y) + static_cast<float>(kBackground);
    }
  add_speckle(laser, stripe.speckle, seed, 1, light);
  Image8 out(laser.width, laser.height);
  Random random(seed, 2);
  for (std::size_t i = 0; i < out.pixels.size(); ++i) {
    const double level = double{light.pixels[i]};
    const double noise = std::sqrt(kReadNoise * kReadNoise + kShotGain * std::max(level, 0.0));
    out.pixels[i] =
        static_cast<std::uint8_t>(std::clamp(std::lround(level + noise * random.gaussian()), 0L, 255L));
  }
  return out;
}

}  // namespace lightstripe
