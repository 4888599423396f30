// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "simulate/speckle.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "core/random.h"

namespace lightstripe {
namespace {

constexpr int kTile = 32;             // px; patterns are made only where the laser shines
constexpr float kFaintest = 0.02F;    // grey levels of laser light whose grain nobody could see
constexpr double kKernelReach = 3.5;  // standard deviations

/// Weights of the independent patterns, of sum 1; the sum of their squares is contrast^2.
std::vector<float> look_weights(double contrast) {
  const double square = contrast * contrast, looks = 1 / square;
  const double whole = std::max(1.0, std::floor(looks + 1e-9));
  std::vector<double> weights(static_cast<std::size_t>(whole), 1.0);
  if (looks - whole > 1e-6) {
    // (n + a^2) / (n + a)^2 = contrast^2 for the last weight a.
    const double p = square * whole / (square - 1), q = (square * whole * whole - whole) / (square - 1);
    weights.push_back(-p - std::sqrt(std::max(0.0, p * p - q)));
  }
  double sum = 0;
  for (const double w : weights) sum += w;
  std::vector<float> out;
  for (const double w : weights) out.push_back(static_cast<float>(w / sum));
  return out;
}

/// The pupil: a Gaussian of grain_px, scaled so that white noise of unit variance keeps it.
std::vector<float> pupil_kernel(double grain_px) {
  const int reach = static_cast<int>(std::ceil(kKernelReach * grain_px));
  std::vector<float> kernel;
  double squares = 0;
  for (int k = -reach; k <= reach; ++k) {
    const double value = std::exp(-0.5 * k * k / (grain_px * grain_px));
    kernel.push_back(static_cast<float>(value));
    squares += value * value;
  }
  for (float& value : kernel) value /= static_cast<float>(std::sqrt(squares));
  return kernel;
}

/// One field's real or imaginary part, or the pattern, over a tile.
using Values = std::vector<float>;

/// Sums over one tile at a time, in memory that is kept.
class TilePattern {
 public:
  TilePattern(const Speckle& speckle, std::uint64_t key)
      : weights_(look_weights(speckle.contrast)), kernel_(pupil_kernel(speckle.grain_px)), key_(key) {}

  /// The pattern over the tile whose first pixel is (x0, y0), rows of kTile values.
  const Values& at(int x0, int y0) {
    pattern_.assign(kTile * kTile, 0.0F);
    for (std::size_t look = 0; look < weights_.size(); ++look) {
      draw_field(x0 - margin(), y0 - margin(), scatter_bits(key_ ^ scatter_bits(look + 1)));
      for (const Values* part : {&real_, &imaginary_}) add_square(*part, weights_[look]);
    }
    return pattern_;
  }

 private:
  int margin() const { return static_cast<int>(kernel_.size() / 2); }
  int side() const { return kTile + 2 * margin(); }

  /// White noise, variance 1/2 in each part, a function of the pixel's place alone.
  void draw_field(int x0, int y0, std::uint64_t key) {
    const auto count = static_cast<std::size_t>(side() * side());
    real_.resize(count);
    imaginary_.resize(count);
    std::size_t i = 0;
    for (int y = y0; y < y0 + side(); ++y)
      for (int x = x0; x < x0 + side(); ++x, ++i) {
        const auto place = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(y)) << 32U) |
                           static_cast<std::uint32_t>(x);
        const std::uint64_t bits = scatter_bits(key ^ scatter_bits(place));
        const float u = static_cast<float>((bits >> 40U) + 1) * 0x1.0p-24F;
        const float angle = static_cast<float>(bits & 0xffffffU) * (0x1.0p-23F * std::numbers::pi_v<float>);
        const float radius = std::sqrt(-std::log(u));
        real_[i] = radius * std::cos(angle);
        imaginary_[i] = radius * std::sin(angle);
      }
  }

  /// Adds the weighted square of the low-passed part.
  void add_square(const Values& part, float weight) {
    const int width = side(), taps = static_cast<int>(kernel_.size());
    columns_.assign(static_cast<std::size_t>(kTile * width), 0.0F);
    for (int y = 0; y < kTile; ++y)
      for (int k = 0; k < taps; ++k) {
        const float* in = part.data() + (y + k) * width;
        float* out = columns_.data() + y * width;
        for (int x = 0; x < width; ++x) out[x] += kernel_[static_cast<std::size_t>(k)] * in[x];
      }
    for (int y = 0; y < kTile; ++y) {
      float row[kTile] = {};
      for (int k = 0; k < taps; ++k) {
        const float* in = columns_.data() + y * width + k;
        for (int x = 0; x < kTile; ++x) row[x] += kernel_[static_cast<std::size_t>(k)] * in[x];
      }
      float* out = pattern_.data() + y * kTile;
      for (int x = 0; x < kTile; ++x) out[x] += weight * row[x] * row[x];
    }
  }

  std::vector<float> weights_;  ///< one a look
  std::vector<float> kernel_;
  std::uint64_t key_;
  Values real_, imaginary_, columns_, pattern_;
};

bool is_lit(const Image<float>& laser, int x0, int y0) {
  for (int y = y0; y < std::min(y0 + kTile, laser.height); ++y)
    for (int x = x0; x < std::min(x0 + kTile, laser.width); ++x)
      if (laser(x, y) > kFaintest) return true;
  return false;
}

}  // namespace

void add_speckle(const Image<float>& laser, const Speckle& speckle, std::uint64_t seed, std::uint64_t stream,
                 Image<float>& light) {
  if (speckle.contrast <= 0) return;
  LIGHTSTRIPE_CHECK(laser.width == light.width && laser.height == light.height,
                    "laser and light are parts of one picture");
  TilePattern tile(speckle, scatter_bits(seed ^ scatter_bits(stream)));
  for (int y0 = 0; y0 < laser.height; y0 += kTile)
    for (int x0 = 0; x0 < laser.width; x0 += kTile) {
      if (!is_lit(laser, x0, y0)) continue;
      const Values& pattern = tile.at(x0, y0);
      for (int y = y0; y < std::min(y0 + kTile, laser.height); ++y)
        for (int x = x0; x < std::min(x0 + kTile, laser.width); ++x)
          light(x, y) += laser(x, y) * (pattern[static_cast<std::size_t>((y - y0) * kTile + x - x0)] - 1);
    }
}

}  // namespace lightstripe
