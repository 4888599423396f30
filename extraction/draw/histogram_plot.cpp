// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/draw/histogram_plot.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>

namespace lightstripe {
namespace {

constexpr int kLeft = 36, kTop = 100, kBar = 3, kFloor = kHistogramPlotHeight - 30;  // px
const cv::Scalar kInk(60, 60, 60);

int column_of(const Histogram& h, double level) {
  return kLeft + static_cast<int>(std::lround((level + 0.5) / h.bin_width * kBar));
}

void draw_bars(const Histogram& h, cv::Mat& picture) {
  const std::uint32_t most = *std::max_element(h.counts.begin(), h.counts.end());
  const double scale = (kFloor - kTop) / std::log1p(std::max(1.0, static_cast<double>(most)));
  for (int bin = 0; bin < Histogram::kBins; ++bin) {
    const int height =
        static_cast<int>(std::lround(scale * std::log1p(h.counts[static_cast<std::size_t>(bin)])));
    if (height > 0)
      cv::rectangle(picture, cv::Rect(kLeft + bin * kBar, kFloor - height, kBar, height),
                    cv::Scalar(150, 170, 200), cv::FILLED);
  }
}

void draw_axis(const Histogram& h, cv::Mat& picture) {
  cv::line(picture, {kLeft, kFloor}, {kLeft + Histogram::kBins * kBar, kFloor}, kInk);
  for (int bin = 0; bin <= Histogram::kBins; bin += 32) {
    const int x = kLeft + bin * kBar;
    cv::line(picture, {x, kFloor}, {x, kFloor + 4}, kInk);
    cv::putText(picture, std::to_string(static_cast<int>(bin * h.bin_width)), {x - 10, kFloor + 20},
                cv::FONT_HERSHEY_SIMPLEX, 0.4, kInk, 1, cv::LINE_AA);
  }
}

struct Mark {
  const char* name;
  double level;
  cv::Scalar colour;
  int thickness;
};

}  // namespace

std::vector<std::uint8_t> draw_histogram(const Histogram& histogram, const ExtractionResult& result) {
  std::vector<std::uint8_t> rgb(static_cast<std::size_t>(kHistogramPlotWidth) * kHistogramPlotHeight * 3,
                                255);
  cv::Mat picture(kHistogramPlotHeight, kHistogramPlotWidth, CV_8UC3, rgb.data());
  draw_bars(histogram, picture);
  draw_axis(histogram, picture);
  const BilevelThresholds& t = result.levels;
  const Mark marks[] = {
      {"T_min", t.t_min, {120, 120, 120}, 1},         {"T_rosin", t.t_rosin, {0, 130, 0}, 1},
      {"T_otsu", t.t_otsu, {200, 120, 0}, 1},         {"T_max", t.t_max, {120, 120, 120}, 1},
      {"T_l", result.threshold_low, {0, 60, 220}, 2}, {"T_h", result.threshold_high, {220, 0, 0}, 2}};
  int row = 0;
  for (const Mark& mark : marks) {
    // Names on rows of their own: the levels often lie side by side.
    const int x = column_of(histogram, mark.level), y = 14 + 15 * row++;
    cv::line(picture, {x, y}, {x, kFloor}, mark.colour, mark.thickness);
    const std::string text =
        std::string(mark.name) + " " + std::to_string(static_cast<int>(std::lround(mark.level)));
    cv::putText(picture, text, {std::min(x + 4, kHistogramPlotWidth - 80), y + 4}, cv::FONT_HERSHEY_SIMPLEX,
                0.45, mark.colour, 1, cv::LINE_AA);
  }
  return rgb;
}

}  // namespace lightstripe
