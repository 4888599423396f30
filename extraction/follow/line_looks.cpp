// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/follow/line_looks.h"

#include <algorithm>
#include <cstdint>

#include "extraction/follow/direction_guided_ridge.h"
#include "extraction/lines/line_measure.h"

namespace lightstripe {

template <class T>
bool is_clipped(ImageView<T> image, std::span<const StripePoint> points, double level) {
  std::size_t clipped = 0;
  for (const StripePoint& p : points) {
    const auto [x, y] = nearest_inside(image, p.x, p.y);
    clipped += image(x, y) >= level ? 1U : 0U;
  }
  return 4 * clipped > points.size();
}

template <class T>
bool is_edge(ImageView<T> image, std::span<const StripePoint> points, double sigma) {
  constexpr double kAside = 2.6,
                   kLeastFlanks = 0.3;  // sigma; of the smaller over the larger drop
  const double reach = kAside * sigma;
  const std::size_t step = std::max<std::size_t>(1, points.size() / 24);
  std::size_t looked_at = 0, one_sided = 0;
  const auto grey = [&](const StripePoint& p, double aside) {
    const auto [x, y] = nearest_inside(image, p.x + aside * p.normal_x, p.y + aside * p.normal_y);
    return static_cast<double>(image(x, y));
  };
  for (std::size_t i = 0; i < points.size(); i += step) {
    const StripePoint& p = points[i];
    const double top = grey(p, 0), left = top - grey(p, -reach), right = top - grey(p, reach);
    ++looked_at;
    one_sided += std::min(left, right) < kLeastFlanks * std::max(left, right) ? 1U : 0U;
  }
  return 2 * one_sided > looked_at;
}

template <class T>
bool runs_beside_another(ImageView<T> image, const ExclusionMask& mask, std::span<const StripePoint> points,
                         double sigma, std::uint16_t first_label, double most) {
  const std::size_t step = sample_step({0, points.size()});
  std::size_t looked_at = 0, taken = 0;
  for (std::size_t i = 0; i < points.size(); i += step) {
    const StripePoint& p = points[i];
    ++looked_at;
    for (const double aside : {-1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5}) {
      const auto x = nearest_pixel(p.x + aside * sigma * p.normal_x),
                 y = nearest_pixel(p.y + aside * sigma * p.normal_y);
      if (!image.contains(x, y)) continue;
      const std::uint16_t label = mask(x, y);
      if (label == ExclusionMask::kFree || label == ExclusionMask::kDead || label >= first_label) continue;
      ++taken;
      break;
    }
  }
  return static_cast<double>(taken) > most * static_cast<double>(looked_at);
}

double mean_strength(std::span<const StripePoint> points) {
  double sum = 0;
  for (const StripePoint& p : points) sum += p.strength;
  return sum / static_cast<double>(points.size());
}

double broader_in_grain(const FollowTuning& t, double grain) {
  return std::clamp(1 + (grain - t.fine_grain) / (t.coarse_grain - t.fine_grain), 1.0, 2.0);
}

template bool is_clipped<std::uint8_t>(ImageView8, std::span<const StripePoint>, double);
template bool is_clipped<std::uint16_t>(ImageView16, std::span<const StripePoint>, double);
template bool is_edge<std::uint8_t>(ImageView8, std::span<const StripePoint>, double);
template bool is_edge<std::uint16_t>(ImageView16, std::span<const StripePoint>, double);
template bool runs_beside_another<std::uint8_t>(ImageView8, const ExclusionMask&,
                                                std::span<const StripePoint>, double, std::uint16_t, double);
template bool runs_beside_another<std::uint16_t>(ImageView16, const ExclusionMask&,
                                                 std::span<const StripePoint>, double, std::uint16_t, double);

}  // namespace lightstripe
