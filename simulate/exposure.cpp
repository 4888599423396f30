// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "simulate/exposure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lightstripe {

double Blob::cover(double px, double py, double edge_px) const {
  const double dx = px - x, dy = py - y, c = std::cos(angle), s = std::sin(angle);
  const double along = c * dx + s * dy, across = (c * dy - s * dx) / flatness;
  const double outside = std::hypot(along, across) - radius_px;
  return 1 / (1 + std::exp(std::clamp(outside / edge_px, -50.0, 50.0)));
}

std::vector<Blob> draw_blobs(const Reflections& plan, int width, int height, Random random) {
  std::vector<Blob> out;
  for (int i = 0; i < plan.per_frame; ++i) {
    Blob blob;
    blob.x = random.uniform(0, width);
    blob.y = random.uniform(0, height);
    blob.radius_px = random.uniform(plan.radius_px[0], plan.radius_px[1]);
    blob.flatness = random.uniform(0.3, 1);
    blob.angle = random.uniform(0, std::numbers::pi);
    out.push_back(blob);
  }
  return out;
}

void add_blobs(Image<float>& light, const std::vector<Blob>& blobs, const Reflections& plan) {
  for (const Blob& blob : blobs) {
    const double reach = blob.radius_px + 12 * plan.edge_px;
    const int x0 = std::max(0, static_cast<int>(blob.x - reach)),
              y0 = std::max(0, static_cast<int>(blob.y - reach));
    const int x1 = std::min(light.width, static_cast<int>(blob.x + reach) + 1);
    const int y1 = std::min(light.height, static_cast<int>(blob.y + reach) + 1);
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x)
        light(x, y) += static_cast<float>(plan.peak * blob.cover(x, y, plan.edge_px));
  }
}

Image<float> channel_light(const Image<float>& total, const Image<float>& laser, const ColourCamera& camera,
                           int channel) {
  const int away = std::abs(channel - static_cast<int>(camera.laser));
  const auto missing = static_cast<float>(1 - std::pow(camera.crosstalk, away));
  Image<float> out = total;
  for (std::size_t i = 0; i < laser.pixels.size(); ++i) out.pixels[i] -= missing * laser.pixels[i];
  return out;
}

Image8 expose(const Image<float>& light, const Imaging& imaging, std::uint64_t seed, std::uint64_t stream) {
  Image8 out(light.width, light.height);
  const double read2 = imaging.read_noise * imaging.read_noise;
  const double shot = imaging.electrons_per_level > 0 ? 1 / imaging.electrons_per_level : 0;
  for (int y = 0; y < light.height; ++y) {
    Random random(seed, scatter_bits(stream) + static_cast<std::uint64_t>(y));
    for (int x = 0; x < light.width; ++x) {
      const double level = light(x, y), variance = read2 + shot * std::max(0.0, level - imaging.dark_level);
      const double noisy = level + (variance > 0 ? std::sqrt(variance) * random.gaussian() : 0);
      out(x, y) = static_cast<std::uint8_t>(std::clamp(std::lround(noisy), 0L, 255L));
    }
  }
  return out;
}

std::vector<std::uint8_t> expose_rgb(const Image<float>& total, const Image<float>& laser,
                                     const Imaging& imaging, std::uint64_t seed, std::uint64_t stream) {
  std::vector<std::uint8_t> out(3 * total.pixels.size());
  for (int channel = 0; channel < 3; ++channel) {
    const Image8 seen = expose(channel_light(total, laser, imaging.colour, channel), imaging, seed,
                               stream + static_cast<std::uint64_t>(channel));
    for (std::size_t i = 0; i < seen.pixels.size(); ++i)
      out[3 * i + static_cast<std::size_t>(channel)] = seen.pixels[i];
  }
  return out;
}

Image8 expose_bayer(const Image<float>& total, const Image<float>& laser, const Imaging& imaging,
                    std::uint64_t seed, std::uint64_t stream) {
  Image<float> mosaic = total;
  for (int channel = 0; channel < 3; ++channel) {
    const Image<float> light = channel_light(total, laser, imaging.colour, channel);
    for (int y = 0; y < light.height; ++y)
      for (int x = 0; x < light.width; ++x)
        if (x % 2 + y % 2 == channel) mosaic(x, y) = light(x, y);
  }
  return expose(mosaic, imaging, seed, stream);
}

}  // namespace lightstripe
