// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/line_measure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "extraction/cross_profile.h"
#include "extraction/line_point.h"

namespace lightstripe {
namespace {

template <class T>
CrossProfile profile_at(ImageView<T> image, const StripePoint& p, double full_width) {
  const bool column = std::abs(p.normal_y) >= std::abs(p.normal_x);
  const double cosine = column ? std::abs(p.normal_y) : std::abs(p.normal_x);
  const int reach = 3 + static_cast<int>(1.25 * full_width / cosine);
  if (column) {
    const int x = std::clamp(static_cast<int>(p.x + 0.5), 0, image.width - 1);
    return measure_profile(column_line(image, x), p.y, reach);
  }
  const int y = std::clamp(static_cast<int>(p.y + 0.5), 0, image.height - 1);
  return measure_profile(row_line(image, y), p.x, reach);
}

}  // namespace

double median_of(std::vector<float>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

template <class T>
void measure_points(ImageView<T> image, const DerivativeKernels& kernels, LineSet& lines,
                    std::vector<float>& contrast) {
  const double full_width = 2 * std::numbers::sqrt3 * kernels.sigma;
  constexpr double kClipped = std::numeric_limits<T>::max() - 1;  // some cameras stop one level short
  contrast.resize(lines.points.size());
  lines.half_level_widths.resize(lines.points.size());
  for (std::size_t i = 0; i < lines.points.size(); ++i) {
    StripePoint& p = lines.points[i];
    const CrossProfile profile = profile_at(image, p, full_width);
    const double cosine = std::max(std::abs(p.normal_x), std::abs(p.normal_y));
    p.width = profile.width() * cosine;
    lines.half_level_widths[i] = static_cast<float>(profile.half_level_width * cosine);
    p.intensity = static_cast<float>(profile.intensity());
    contrast[i] = static_cast<float>(profile.contrast());
    if (profile.brightest >= kClipped) p.flags |= kStripeSaturated;
    if (std::abs(profile.left - profile.right) > 0.35 * profile.width()) p.flags |= kStripeAsymmetric;
  }
}

template void measure_points<std::uint8_t>(ImageView8, const DerivativeKernels&, LineSet&,
                                           std::vector<float>&);
template void measure_points<std::uint16_t>(ImageView16, const DerivativeKernels&, LineSet&,
                                            std::vector<float>&);

namespace {

/// Sums over the measured points of a window that slides along a line.
struct SlidingMeans {
  double foot = 0, half = 0, intensity = 0;
  int used = 0;

  void add(const StripePoint& p, float half_width, int sign) {
    if ((p.flags & kStripeBridged) != 0) return;
    foot += sign * p.width;
    half += sign * static_cast<double>(half_width);
    intensity += sign * static_cast<double>(p.intensity);
    used += sign;
  }
};

}  // namespace

void smooth_measures(const DerivativeKernels& kernels, LineSet& lines, std::vector<StripePoint>& scratch) {
  const auto reach = static_cast<std::size_t>(std::lround(1.5 * kernels.sigma));
  for (const LineRange& r : lines.lines) {
    scratch.assign(lines.points.begin() + static_cast<std::ptrdiff_t>(r.begin),
                   lines.points.begin() + static_cast<std::ptrdiff_t>(r.end));
    const float* half = lines.half_level_widths.data() + r.begin;
    SlidingMeans means;
    std::size_t first = 0, end = 0;
    for (std::size_t i = 0; i < scratch.size(); ++i) {
      for (; end < std::min(scratch.size(), i + reach + 1); ++end) means.add(scratch[end], half[end], +1);
      for (; first + reach < i; ++first) means.add(scratch[first], half[first], -1);
      if (means.used == 0) continue;
      lines.points[r.begin + i].width = bar_width(means.foot / means.used, means.half / means.used);
      lines.points[r.begin + i].intensity = static_cast<float>(means.intensity / means.used);
    }
  }
}

void predict_errors(const DerivativeKernels& kernels, double noise, LineSet& lines) {
  for (StripePoint& p : lines.points) {
    p.sigma_px = centre_sigma(kernels, noise, p.strength);
    // A bridged point is as good as the curve between its neighbours: far worse than a measured one.
    if ((p.flags & kStripeBridged) != 0) p.sigma_px = std::max(5 * p.sigma_px, 0.1 * kernels.sigma);
  }
}

}  // namespace lightstripe
