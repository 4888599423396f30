// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/image/stripe_width.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "extraction/lines/cross_profile.h"

namespace lightstripe {
namespace {

constexpr int kReach = 28;  // px: stripes up to about this half width are found

struct WidthSample {
  double width = 0;
  double weight = 0;
};

/// Grey level at the centre, and from it in each direction the distance to the width level above the lowest
/// grey value within kReach. Nothing where a brighter pixel comes first (this is a flank) or no flank is
/// found.
template <class T>
std::optional<CrossProfile> bar_profile(const PixelLine<T>& line, int centre, double top) {
  CrossProfile p;
  p.top = top;
  double distance[2] = {0, 0}, background[2] = {0, 0};
  for (int side = 0; side < 2; ++side) {
    const int direction = side == 0 ? -1 : 1;
    double lowest = top;
    int k = 1;
    // Up to the valley: the first place from which the grey value rises by more than half of what it fell.
    for (; k <= kReach && centre + direction * k >= 0 && centre + direction * k < line.count; ++k) {
      const double grey = line[centre + direction * k];
      if (grey > lowest + std::max(0.25 * (top - lowest), 0.5) && lowest < 0.8 * top) break;
      lowest = std::min(lowest, grey);
    }
    const double level = lowest + kWidthLevel * (top - lowest);
    double previous = top;
    for (int i = 1; i < k; ++i) {
      const double grey = line[centre + direction * i];
      if (grey < level) {
        distance[side] = i - 1 + (previous - level) / std::max(previous - grey, 1e-9);
        break;
      }
      previous = grey;
    }
    background[side] = lowest;
  }
  p.left = distance[0];
  p.right = distance[1];
  p.background_left = background[0];
  p.background_right = background[1];
  p.bounded = p.left > 0 && p.right > 0;
  if (!p.bounded) return std::nullopt;
  return p;
}

/// The local maxima along one line; plateaus (saturated stripes) count once, at their middle.
template <class T>
void sample_maxima(ImageView<T> image, bool along_row, int position, double level, double contrast,
                   std::vector<WidthSample>& samples) {
  const PixelLine<T> line = along_row ? row_line(image, position) : column_line(image, position);
  for (int i = 2; i + 2 < line.count; ++i) {
    if (line[i] < level || line[i] <= line[i - 1]) continue;
    int end = i;
    while (end + 1 < line.count && line[end + 1] == line[i]) ++end;
    const int middle = (i + end) / 2;
    const bool top = end + 1 < line.count && line[end + 1] < line[i] && line[i] >= line[i - 2] &&
                     (end + 2 >= line.count || line[i] >= line[end + 2]);
    const double grey = line[i];
    i = end;
    if (!top) continue;
    const auto across = bar_profile(line, middle, grey);
    // Noise makes small maxima on the flanks of a wide stripe: small against what they stand on.
    if (!across || across->contrast() < std::max(contrast, 0.35 * (grey - level))) continue;
    // A line at angle a is cut to width / cos a by the one and width / sin a by the other.
    double width = across->width(), longer = width;
    const PixelLine<T> other = along_row ? column_line(image, middle) : row_line(image, middle);
    const auto along = bar_profile(other, position, grey);
    if (along && along->contrast() > 0.3 * across->contrast()) {
      // The line's grey value varies along it: what looks like a flank there has to be as steep as this one
      // is.
      const double v = along->width();
      if (v < 3.0 * width) {
        longer = std::max(width, v);
        width = width * v / std::hypot(width, v);
      }
    }
    samples.push_back({width, std::pow(across->contrast() / longer, 2.5)});
  }
}

/// The peak of the samples' distribution over the logarithm of the width, and the mean around it. Each sample
/// counts by its sharpness (contrast / width) to the power 2.5: squares of a board may be as bright as
/// stripes and many more, but they are wider and of all widths.
double commonest_width(const std::vector<WidthSample>& samples) {
  constexpr int kBins = 52;
  constexpr double kPerBin = 0.09;  // of the natural logarithm; the last bin lies at 108 px
  std::array<double, kBins + 2> weights{};
  const auto bin_of = [](double width) {
    return 1 +
           std::clamp(static_cast<int>(std::lround(std::log(std::max(width, 1.0)) / kPerBin)), 0, kBins - 1);
  };
  std::array<std::size_t, kBins + 2> counts{};
  for (const WidthSample& s : samples) {
    weights[static_cast<std::size_t>(bin_of(s.width))] += s.weight;
    ++counts[static_cast<std::size_t>(bin_of(s.width))];
  }
  // A few very sharp samples (the tips of stripes, hot pixels) are no peak.
  const std::size_t least = std::min<std::size_t>(6, samples.size()) + samples.size() / 100;
  int peak = 1;
  double highest = -1;
  for (int bin = 1; bin <= kBins; ++bin) {
    const auto b = static_cast<std::size_t>(bin);
    const double smooth = weights[b - 1] + 2 * weights[b] + weights[b + 1];
    if (smooth <= highest || counts[b - 1] + counts[b] + counts[b + 1] < std::min(least, samples.size() / 3))
      continue;
    highest = smooth;
    peak = bin;
  }
  double sum = 0, total = 0;
  for (const WidthSample& s : samples) {
    if (std::abs(bin_of(s.width) - peak) > 2) continue;
    sum += s.weight * s.width;
    total += s.weight;
  }
  return sum / total;
}

}  // namespace

template <class T>
std::optional<double> estimate_stripe_width(ImageView<T> image, double level, double contrast) {
  std::vector<WidthSample> samples;
  const int row_step = std::max(1, image.height / 96), column_step = std::max(1, image.width / 96);
  for (int y = row_step / 2; y < image.height; y += row_step)
    sample_maxima(image, true, y, level, contrast, samples);
  for (int x = column_step / 2; x < image.width; x += column_step)
    sample_maxima(image, false, x, level, contrast, samples);
  if (samples.empty()) return std::nullopt;
  return commonest_width(samples);
}

template std::optional<double> estimate_stripe_width<std::uint8_t>(ImageView8, double, double);
template std::optional<double> estimate_stripe_width<std::uint16_t>(ImageView16, double, double);

}  // namespace lightstripe
