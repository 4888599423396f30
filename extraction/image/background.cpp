// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/image/background.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/error.h"
#include "extraction/image/noise.h"
#include "extraction/kernels/kernels_scan.h"

namespace lightstripe {
namespace {

constexpr int kLevels = 256;
constexpr int kClipped = 250;             // dark pixels from here on say nothing about the light
constexpr std::uint32_t kMinPixels = 50;  // of a grey level, for its median to count

struct LevelMedian {
  double dark, lit, weight;
};

/// Bits to take away so that 256 levels hold both pictures.
template <class T>
int level_shift(ImageView<T> lit, ImageView<T> dark) {
  if constexpr (sizeof(T) == 1) return 0;
  const T largest = std::max(largest_pixel(lit), largest_pixel(dark));
  int shift = 0;
  while ((largest >> shift) >= kLevels) ++shift;
  return shift;
}

template <class T>
std::vector<LevelMedian> level_medians(ImageView<T> lit, ImageView<T> dark, int shift) {
  std::vector<std::uint32_t> joint(static_cast<std::size_t>(kLevels) * kLevels);
  for (int y = 0; y < dark.height; ++y)
    for (int x = 0; x < dark.width; ++x)
      ++joint[static_cast<std::size_t>(dark(x, y) >> shift) * kLevels +
              static_cast<std::size_t>(lit(x, y) >> shift)];
  std::vector<LevelMedian> medians;
  for (int level = 0; level < kClipped; ++level) {
    const std::uint32_t* row = joint.data() + static_cast<std::ptrdiff_t>(level) * kLevels;
    std::uint32_t total = 0;
    for (int i = 0; i < kLevels; ++i) total += row[i];
    if (total < kMinPixels) continue;
    int median = 0;
    for (std::uint32_t below = row[0]; 2 * below < total;) below += row[++median];
    medians.push_back(
        {static_cast<double>(level), static_cast<double>(median), std::sqrt(static_cast<double>(total))});
  }
  return medians;
}

/// Weighted least squares; gain 1 where the levels do not spread enough to tell.
AmbientChange fit_line(const std::vector<LevelMedian>& medians) {
  constexpr double kMinSpread = 5;  // grey levels
  double w = 0, mean_dark = 0, mean_lit = 0;
  for (const auto& m : medians) {
    w += m.weight;
    mean_dark += m.weight * m.dark;
    mean_lit += m.weight * m.lit;
  }
  if (!(w > 0)) return {};
  mean_dark /= w;
  mean_lit /= w;
  double variance = 0, covariance = 0;
  for (const auto& m : medians) {
    variance += m.weight * (m.dark - mean_dark) * (m.dark - mean_dark) / w;
    covariance += m.weight * (m.dark - mean_dark) * (m.lit - mean_lit) / w;
  }
  const double gain = variance > kMinSpread * kMinSpread ? std::max(0.0, covariance / variance) : 1.0;
  return {gain, mean_lit - gain * mean_dark};
}

/// In units of the shifted levels.
template <class T>
AmbientChange fit_change(ImageView<T> lit, ImageView<T> dark, int shift) {
  LIGHTSTRIPE_CHECK(lit.width == dark.width && lit.height == dark.height, "a pair has one size");
  auto medians = level_medians(lit, dark, shift);
  AmbientChange change = fit_line(medians);
  // A level that lies mostly under the stripe or a reflection does not follow the others: once more without
  // such.
  constexpr double kOutlier = 15;  // grey levels
  std::erase_if(medians, [&](const auto& m) {
    return std::abs(m.lit - change.gain * m.dark - change.offset) > kOutlier;
  });
  if (medians.size() >= 2) change = fit_line(medians);
  return change;
}

/// What the subtraction is done with.
template <class T>
struct Ambient {
  AmbientChange change;  ///< grey levels of the pictures
  double dark_level = 0;

  /// Grey levels of the laser's light.
  double light(T lit, T dark) const { return lit - (change.gain * dark + change.offset); }
  /// The same over the dark level, as a pixel.
  T pixel(double light) const {
    constexpr double kMost = std::numeric_limits<T>::max();
    return static_cast<T>(std::clamp(light + dark_level, 0.0, kMost) + 0.5);
  }
};

template <class T>
Ambient<T> ambient_of(ImageView<T> lit, ImageView<T> dark, int shift) {
  AmbientChange change = fit_change(lit, dark, shift);
  change.offset *= 1 << shift;
  return {change, static_cast<double>(kDarkLevel << shift)};
}

/// By how much a pixel is clearly darker than without the laser; `shift`: as level_shift().
template <class T>
double clearly_darker(ImageView<T> lit, int shift) {
  constexpr double kLeastDarker = 10, kSigmas = 8;  // of 256 levels; of the lit picture's noise
  return std::max(kLeastDarker * (1 << shift), kSigmas * estimate_noise(lit, 8).full);
}

}  // namespace

AmbientChange fit_ambient_change(ImageView8 lit, ImageView8 dark) { return fit_change(lit, dark, 0); }
AmbientChange fit_ambient_change(ImageView16 lit, ImageView16 dark) {
  return ambient_of(lit, dark, level_shift(lit, dark)).change;
}

Image8 laser_light(ImageView8 lit, ImageView8 dark) {
  const Ambient<std::uint8_t> ambient = ambient_of(lit, dark, 0);
  Image8 light(lit.width, lit.height);
  for (int y = 0; y < lit.height; ++y)
    for (int x = 0; x < lit.width; ++x) light(x, y) = ambient.pixel(ambient.light(lit(x, y), dark(x, y)));
  return light;
}

template <class T>
LaserLight<T> subtract_background(const Image<T>& lit, const Image<T>& dark) {
  constexpr int kMost = std::numeric_limits<T>::max();
  const int shift = level_shift(lit.view(), dark.view());
  const Ambient<T> ambient = ambient_of(lit.view(), dark.view(), shift);
  const double much_darker = clearly_darker(lit.view(), shift);
  LaserLight<T> light;
  light.change = ambient.change;
  light.image = Image<T>(lit.width, lit.height);
  light.image.where = lit.where;
  light.image.rise = lit.rise;
  if (lit.where.empty()) light.image.where.assign(lit.pixels.size(), LaserPlace::kSure);
  std::size_t darker = 0;
  for (std::size_t i = 0; i < lit.pixels.size(); ++i) {
    const double rest = ambient.light(lit.pixels[i], dark.pixels[i]);
    light.image.pixels[i] = ambient.pixel(rest);
    darker += rest < -much_darker ? 1U : 0U;
    std::uint8_t& place = light.image.where[i];
    if (lit.pixels[i] >= kMost - 1 && place == LaserPlace::kSure) place = LaserPlace::kClipped;
  }
  light.darker_share =
      static_cast<double>(darker) / static_cast<double>(std::max<std::size_t>(1, lit.pixels.size()));
  return light;
}

template LaserLight<std::uint8_t> subtract_background(const Image8&, const Image8&);
template LaserLight<std::uint16_t> subtract_background(const Image16&, const Image16&);

}  // namespace lightstripe
