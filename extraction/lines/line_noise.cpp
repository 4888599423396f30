// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/line_noise.h"

#include <algorithm>
#include <cmath>

#include "extraction/follow/line_point.h"
#include "extraction/lines/cross_profile.h"
#include "extraction/lines/line_measure.h"

namespace lightstripe {
namespace {

/// How fast grey levels fall beside the ridge, by the top of a Gaussian of the point's width: they fall by
/// this times the squared distance.
double fall_of(const StripePoint& p) {
  return 0.5 * static_cast<double>(p.intensity) / std::max(p.width * p.width / 12, 0.25);  // 2 sqrt(3) s
}

/// The ridge's grey value at a point: that of the nearest pixel, put right for its distance from the centre
/// line.
template <class T>
double ridge_grey(ImageView<T> image, const StripePoint& p, double fall) {
  const int x = std::clamp(static_cast<int>(p.x + 0.5), 0, image.width - 1);
  const int y = std::clamp(static_cast<int>(p.y + 0.5), 0, image.height - 1);
  const double across = (x - p.x) * p.normal_x + (y - p.y) * p.normal_y;
  return image(x, y) + fall * across * across;
}

bool is_usable(const StripePoint& p) { return (p.flags & (kStripeBridged | kStripeSaturated)) == 0; }

bool are_neighbours(const StripePoint& a, const StripePoint& b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  return dx * dx + dy * dy < 4.0;
}

}  // namespace

template <class T>
double noise_on_ridge(ImageView<T> image, const LineSet& lines, const LineRange& range,
                      double background_noise, std::vector<float>& scratch) {
  constexpr std::size_t kLeast = 20, kEnough = 250;
  constexpr double kToSigma = 1.4826 / 2.449489743;  // of a normal; second differences have sqrt(6) sigma
  const std::size_t step = 1 + range.size() / kEnough;
  scratch.clear();
  for (std::size_t i = range.begin + 1; i + 1 < range.end; i += step) {
    const StripePoint &a = lines.points[i - 1], &b = lines.points[i], &c = lines.points[i + 1];
    if (!is_usable(a) || !is_usable(b) || !is_usable(c) || !are_neighbours(a, b) || !are_neighbours(b, c))
      continue;
    const double fall = fall_of(b);
    const double second =
        ridge_grey(image, a, fall) - 2 * ridge_grey(image, b, fall) + ridge_grey(image, c, fall);
    scratch.push_back(static_cast<float>(std::abs(second)));
  }
  return scratch.size() < kLeast ? background_noise : kToSigma * median_of(scratch);
}

template <class T>
void predict_errors(ImageView<T> image, const DerivativeKernels& kernels, double background_noise,
                    LineSet& lines, std::vector<float>& scratch) {
  // The first derivative's kernel sees the flanks: of a Gaussian stripe of its own scale, on average this
  // share of the peak's light, (2/3)^1.5.
  constexpr double kFlankShare = 0.5443;
  const double background = background_noise * background_noise;
  for (const LineRange& r : lines.lines) {
    const double top = noise_on_ridge(image, lines, r, background_noise, scratch);
    scratch.clear();
    for (std::size_t i = r.begin; i < r.end; i += sample_step(r))
      scratch.push_back(lines.points[i].intensity);
    const double typical = std::max(1.0, double{median_of(scratch)});
    const double added = kFlankShare * std::max(0.0, top * top - background) / typical;
    for (std::size_t i = r.begin; i < r.end; ++i) {
      StripePoint& p = lines.points[i];
      const double noise = std::sqrt(background + added * std::max(0.0, static_cast<double>(p.intensity)));
      p.sigma_px = centre_sigma(kernels, noise, p.strength);
      // A bridged point is as good as the curve between its neighbours: far worse than a measured one.
      if ((p.flags & kStripeBridged) != 0) p.sigma_px = std::max(5 * p.sigma_px, 0.1 * kernels.sigma);
    }
  }
}

template double noise_on_ridge<std::uint8_t>(ImageView8, const LineSet&, const LineRange&, double,
                                             std::vector<float>&);
template double noise_on_ridge<std::uint16_t>(ImageView16, const LineSet&, const LineRange&, double,
                                              std::vector<float>&);
template void predict_errors<std::uint8_t>(ImageView8, const DerivativeKernels&, double, LineSet&,
                                           std::vector<float>&);
template void predict_errors<std::uint16_t>(ImageView16, const DerivativeKernels&, double, LineSet&,
                                            std::vector<float>&);

}  // namespace lightstripe
