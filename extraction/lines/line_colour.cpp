// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/line_colour.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "extraction/follow/direction_guided_ridge.h"
#include "extraction/lines/line_measure.h"
#include "extraction/lines/ranked_value.h"

namespace lightstripe {
namespace {

/// Full widths from the centre to where the colour of the surroundings is read: 3 standard deviations of a
/// Gaussian stripe.
constexpr double kAsideOfLight = 0.9;
/// Full widths from the centre to the rims, which are more coloured than a core too bright for its colour.
constexpr double kAsideOfCore = 0.5;
/// Pixels, at least so far aside: the colour is known in means of 3 x 3 pixels.
constexpr double kLeastAside = 3;
/// Of the points that are looked at: with fewer unclipped ones the colour of the line is not known.
constexpr double kLeastKnown = 0.5;
/// Of the rise that the line has elsewhere, and of the one that belongs to the grey value here: below both of
/// them light is not the laser's.
constexpr double kAstray = 0.4;
/// Grey levels: where less rise is expected, quantisation and noise hide the colour.
constexpr double kClearRise = 12;
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

template <class T>
int rise_at(ImageView<T> image, double x, double y) {
  const NearestPixel at = nearest_inside(image, x, y);
  return image.rise[at.y * image.stride + at.x];
}

/// Rise of the colour at one point, or on both rims of the line, over the mean of both sides, grey levels;
/// NaN in a clipped core.
template <class T>
float rise_over_sides(ImageView<T> image, const StripePoint& p, double rim, double aside) {
  const auto beside = [&](double distance) {
    return rise_at(image, p.x + distance * p.normal_x, p.y + distance * p.normal_y);
  };
  const int at = beside(0);
  if (at == kClippedRise) return kUnknown;
  const int rims = std::min(beside(-rim), beside(rim));
  if (rims == kClippedRise) return kUnknown;
  return static_cast<float>(std::max(at, rims)) - 0.5F * static_cast<float>(beside(-aside) + beside(aside));
}

double median_of_known(const std::vector<float>& values, std::vector<float>& scratch) {
  scratch.clear();
  std::copy_if(values.begin(), values.end(), std::back_inserter(scratch),
               [](float v) { return !std::isnan(v); });
  return ranked_median(scratch);
}

/// Every `step`-th point.
template <class T>
LineColour look_at_line(ImageView<T> image, const LineSet& lines, const LineRange& range, double width,
                        std::size_t step, ColourWorkspace& w) {
  const double aside = std::max(kLeastAside, kAsideOfLight * width);
  w.rises.clear();
  w.shares.clear();
  std::size_t looked_at = 0, known = 0;
  for (std::size_t i = range.begin; i < range.end; i += step) {
    const StripePoint& p = lines.points[i];
    const bool bridged = (p.flags & kStripeBridged) != 0;
    const float rise = bridged ? kUnknown : rise_over_sides(image, p, kAsideOfCore * width, aside);
    looked_at += bridged ? 0U : 1U;
    known += std::isnan(rise) ? 0U : 1U;
    w.rises.push_back(rise);
    w.shares.push_back(rise / std::max(1.0F, p.intensity));
  }
  if (known == 0 || static_cast<double>(known) < kLeastKnown * static_cast<double>(looked_at)) return {};
  return {true, median_of_known(w.rises, w.scratch), median_of_known(w.shares, w.scratch)};
}

}  // namespace

template <class T>
LineColour colour_of_line(ImageView<T> image, const LineSet& lines, const LineRange& range, double width,
                          ColourWorkspace& workspace) {
  if (image.rise == nullptr) return {};
  return look_at_line(image, lines, range, width, sample_step(range), workspace);
}

template <class T>
void place_points(ImageView<T> image, const LineSet& lines, const LineRange& range, double width,
                  ColourWorkspace& w, std::vector<std::uint8_t>& place) {
  for (std::size_t i = range.begin; i < range.end; ++i) {
    const StripePoint& p = lines.points[i];
    const NearestPixel at = nearest_inside(image, p.x, p.y);
    place[i] = image.laser_colour(at.x, at.y);
  }
  if (image.rise == nullptr) return;
  const LineColour line = look_at_line(image, lines, range, width, 1, w);
  if (!line.known) return;
  // Means along the line, about as long as it is wide.
  const auto reach = static_cast<std::size_t>(std::lround(std::max(1.0, 0.5 * width)));
  double rise = 0, intensity = 0, known = 0;
  const auto add = [&](std::size_t k, double sign) {
    if (std::isnan(w.rises[k])) return;
    rise += sign * double{w.rises[k]};
    intensity += sign * double{lines.points[range.begin + k].intensity};
    known += sign;
  };
  std::size_t first = 0, end = 0;
  for (std::size_t i = 0; i < range.size(); ++i) {
    for (; end < std::min(range.size(), i + reach + 1); ++end) add(end, 1);
    for (; first + reach < i; ++first) add(first, -1);
    const double expected = line.share * intensity;
    if (2 * known > static_cast<double>(end - first) && expected > kClearRise * known &&
        rise < kAstray * expected && rise < kAstray * line.rise * known)
      place[range.begin + i] = LaserPlace::kOtherLight;
  }
}

template LineColour colour_of_line<std::uint8_t>(ImageView8, const LineSet&, const LineRange&, double,
                                                 ColourWorkspace&);
template LineColour colour_of_line<std::uint16_t>(ImageView16, const LineSet&, const LineRange&, double,
                                                  ColourWorkspace&);
template void place_points<std::uint8_t>(ImageView8, const LineSet&, const LineRange&, double,
                                         ColourWorkspace&, std::vector<std::uint8_t>&);
template void place_points<std::uint16_t>(ImageView16, const LineSet&, const LineRange&, double,
                                          ColourWorkspace&, std::vector<std::uint8_t>&);

}  // namespace lightstripe
