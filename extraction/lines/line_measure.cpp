// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/line_measure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "extraction/kernels/width_rule.h"
#include "extraction/lines/cross_profile.h"
#include "extraction/lines/ranked_value.h"

namespace lightstripe {
namespace {

/// The row or column that crosses a line at one point.
template <class T>
struct Crossing {
  PixelLine<T> line;
  double centre = 0;  ///< px along the row or column
  double cosine = 1;  ///< of the angle between it and the normal
};

template <class T>
Crossing<T> crossing_at(ImageView<T> image, const StripePoint& p) {
  const double nx = std::abs(p.normal_x), ny = std::abs(p.normal_y);
  if (ny >= nx)
    return {column_line(image, std::clamp(static_cast<int>(p.x + 0.5), 0, image.width - 1)), p.y, ny};
  return {row_line(image, std::clamp(static_cast<int>(p.y + 0.5), 0, image.height - 1)), p.x, nx};
}

int profile_reach(double full_width, double cosine) {
  return 3 + static_cast<int>(1.25 * full_width / cosine);
}

void set_measures(const CrossProfile& profile, double cosine, double clipped_level, std::size_t i,
                  LineSet& lines, LineMeasures& m) {
  StripePoint& p = lines.points[i];
  p.width = profile.width() * cosine;
  lines.half_level_widths[i] = static_cast<float>(profile.half_level_width * cosine);
  p.intensity = static_cast<float>(profile.intensity());
  m.contrast[i] = static_cast<float>(profile.contrast());
  if (profile.brightest >= clipped_level) p.flags |= kStripeSaturated;
  if (std::abs(profile.left - profile.right) > 0.35 * profile.width()) p.flags |= kStripeAsymmetric;
}

/// How many neighbours on each side have to be averaged before noise is small against the line's height.
std::size_t averaging_reach(const DerivativeKernels& kernels, double noise, const LineSet& lines,
                            const LineRange& r, LineMeasures& m) {
  m.values.clear();
  for (std::size_t i = r.begin; i < r.end; i += sample_step(r))
    m.values.push_back(static_cast<float>(lines.points[i].strength));
  const double height = ranked_median(m.values) / kernels.matched_strength(),
               ratio = 10 * noise / std::max(height, 1e-9);
  return static_cast<std::size_t>(std::min(0.5 * ratio * ratio, 3 * kernels.sigma));
}

/// Adds (sign 1) or takes away (sign -1) the pixels around a point's centre.
template <class T>
void add_pixels(const Crossing<T>& c, int reach, float sign, std::vector<float>& sums) {
  const int centre = static_cast<int>(c.centre + 0.5);
  for (int k = -reach; k <= reach; ++k)
    sums[static_cast<std::size_t>(k + reach)] +=
        sign * static_cast<float>(c.line[std::clamp(centre + k, 0, c.line.count - 1)]);
}

/// The points of one line, each by the mean profile of its neighbours.
template <class T>
void measure_averaged(ImageView<T> image, double full_width, double clipped_level, std::size_t neighbours,
                      const LineRange& r, LineSet& lines, LineMeasures& m) {
  const int reach = profile_reach(full_width, 0.7);
  m.sums.assign(static_cast<std::size_t>(2 * reach + 1), 0.0F);
  m.profile.resize(m.sums.size());
  std::size_t first = r.begin, end = r.begin;
  for (std::size_t i = r.begin; i < r.end; ++i) {
    for (; end < std::min(r.end, i + neighbours + 1); ++end)
      add_pixels(crossing_at(image, lines.points[end]), reach, 1.0F, m.sums);
    for (; first + neighbours < i; ++first)
      add_pixels(crossing_at(image, lines.points[first]), reach, -1.0F, m.sums);
    const float scale = 1.0F / static_cast<float>(end - first);
    for (std::size_t k = 0; k < m.sums.size(); ++k) m.profile[k] = scale * m.sums[k];
    const PixelLine<float> line{m.profile.data(), 1, static_cast<int>(m.profile.size())};
    const Crossing<T> c = crossing_at(image, lines.points[i]);
    const double centre = reach + c.centre - static_cast<int>(c.centre + 0.5);
    set_measures(measure_profile(line, centre, profile_reach(full_width, c.cosine)), c.cosine, clipped_level,
                 i, lines, m);
  }
}

/// The points between two measured ones.
void fill_between(std::size_t a, std::size_t b, LineSet& lines, LineMeasures& m) {
  const StripePoint p = lines.points[a], q = lines.points[b];
  const auto flags = static_cast<std::uint8_t>((p.flags | q.flags) & (kStripeSaturated | kStripeAsymmetric));
  for (std::size_t i = a + 1; i < b; ++i) {
    const float u = static_cast<float>(i - a) / static_cast<float>(b - a), v = 1 - u;
    StripePoint& between = lines.points[i];
    between.width = double{v} * p.width + double{u} * q.width;
    between.intensity = v * p.intensity + u * q.intensity;
    between.flags |= flags;
    m.contrast[i] = v * m.contrast[a] + u * m.contrast[b];
    lines.half_level_widths[i] = v * lines.half_level_widths[a] + u * lines.half_level_widths[b];
  }
}

/// The points of one line by their own profiles: all of them near its ends, where each counts, further in one
/// in sigma.
template <class T>
void measure_singly(ImageView<T> image, double sigma, double full_width, double clipped_level,
                    const LineRange& r, LineSet& lines, LineMeasures& m) {
  const auto edge = static_cast<std::size_t>(4 * sigma);
  const auto stride = static_cast<std::size_t>(std::clamp(static_cast<int>(sigma), 1, 4));
  std::size_t last = r.begin;
  for (std::size_t i = r.begin; i < r.end;) {
    const Crossing<T> c = crossing_at(image, lines.points[i]);
    set_measures(measure_profile(c.line, c.centre, profile_reach(full_width, c.cosine)), c.cosine,
                 clipped_level, i, lines, m);
    if (i > last + 1) fill_between(last, i, lines, m);
    last = i;
    i += i >= r.begin + edge && i + edge + stride < r.end ? stride : 1;
  }
}

}  // namespace

template <class T>
void measure_points(ImageView<T> image, const DerivativeKernels& kernels, double noise, LineSet& lines,
                    LineMeasures& m) {
  const double full_width = full_width_of(kernels.sigma);
  constexpr double kClipped = std::numeric_limits<T>::max() - 1;  // some cameras stop one level short
  m.contrast.resize(lines.points.size());
  lines.half_level_widths.resize(lines.points.size());
  m.averaged.clear();
  for (const LineRange& r : lines.lines) {
    const std::size_t neighbours = averaging_reach(kernels, noise, lines, r, m);
    m.averaged.push_back(2.0 * static_cast<double>(neighbours) + 1);
    if (neighbours > 0) {
      measure_averaged(image, full_width, kClipped, neighbours, r, lines, m);
      continue;
    }
    measure_singly(image, kernels.sigma, full_width, kClipped, r, lines, m);
  }
}

template void measure_points<std::uint8_t>(ImageView8, const DerivativeKernels&, double, LineSet&,
                                           LineMeasures&);
template void measure_points<std::uint16_t>(ImageView16, const DerivativeKernels&, double, LineSet&,
                                            LineMeasures&);

namespace {

/// Sums over the measured points of a window that slides along a line. In single precision, which keeps sums
/// of grey levels of 16 bits to 0.1.
struct SlidingMeans {
  std::array<float, 4> sums{};  ///< width, width at half the peak, intensity and 1; bridged points count 0

  void add(const float* values) {
    for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += values[k];
  }
  void remove(const float* values) {
    for (std::size_t k = 0; k < sums.size(); ++k) sums[k] -= values[k];
  }
};

/// What SlidingMeans adds up, one point after the other.
void collect_measures(const LineSet& lines, const LineRange& r, std::vector<float>& values) {
  values.resize(4 * r.size());
  float* out = values.data();
  for (std::size_t i = r.begin; i < r.end; ++i, out += 4) {
    const StripePoint& p = lines.points[i];
    const float used = (p.flags & kStripeBridged) != 0 ? 0.0F : 1.0F;
    out[0] = used * static_cast<float>(p.width);
    out[1] = used * lines.half_level_widths[i];
    out[2] = used * p.intensity;
    out[3] = used;
  }
}

}  // namespace

void smooth_measures(const DerivativeKernels& kernels, LineSet& lines, std::vector<float>& values) {
  const auto reach = static_cast<std::size_t>(std::lround(1.5 * kernels.sigma));
  for (const LineRange& r : lines.lines) {
    collect_measures(lines, r, values);
    SlidingMeans means;
    const std::size_t count = r.size();
    for (std::size_t i = 0; i < std::min(count, reach); ++i) means.add(values.data() + 4 * i);
    for (std::size_t i = 0; i < count; ++i) {
      if (i + reach < count) means.add(values.data() + 4 * (i + reach));
      if (i > reach) means.remove(values.data() + 4 * (i - reach - 1));
      const auto& [foot, half, intensity, used] = means.sums;
      if (used < 0.5F) continue;
      const float scale = 1 / used;
      StripePoint& p = lines.points[r.begin + i];
      p.width = bar_width(double{foot * scale}, double{half * scale});
      p.intensity = intensity * scale;
    }
  }
}

}  // namespace lightstripe
