// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/compare/zhou_roi.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "extraction/compare/link_points.h"

namespace lightstripe {
namespace {

/// 255 inside the region of interest.
template <class T>
cv::Mat region_of_interest(ImageView<T> image, double threshold, double sigma) {
  cv::Mat region(image.height, image.width, CV_8U);
  for (int y = 0; y < image.height; ++y) {
    const T* row = image.row(y);
    std::uint8_t* out = region.ptr<std::uint8_t>(y);
    for (int x = 0; x < image.width; ++x) out[x] = row[x] > threshold ? 255 : 0;
  }
  const int size = 2 * static_cast<int>(std::ceil(sigma)) + 1;
  cv::dilate(region, region, cv::getStructuringElement(cv::MORPH_RECT, cv::Size(size, size)));
  return region;
}

}  // namespace

template <class T>
void find_lines_zhou(ImageView<T> image, const DerivativeKernels& kernels, const RidgeLimits& limits,
                     double threshold, WholeImageWorkspace& workspace, LineSet& lines) {
  const double level = limits.hard_levels ? limits.level_low : threshold;
  const cv::Mat region = region_of_interest(image, level, kernels.sigma);
  LinePointMap& map = workspace.map;
  map.reset(image.width, image.height);
  std::vector<T> border_window;
  for (int y = 0; y < image.height; ++y) {
    const std::uint8_t* inside = region.ptr<std::uint8_t>(y);
    for (int x = 0; x < image.width; ++x) {
      if (inside[x] == 0) continue;
      const Derivatives d = evaluate_derivatives(image, PhasedPosition{x, 0}, PhasedPosition{y, 0}, kernels,
                                                 0, 0, border_window);
      map.test_pixel(x, y, d, limits.follow_strength);
    }
  }
  link_points(map, limits.start_strength, lines);
  refine_points(image, kernels, lines);
}

template void find_lines_zhou<std::uint8_t>(ImageView8, const DerivativeKernels&, const RidgeLimits&, double,
                                            WholeImageWorkspace&, LineSet&);
template void find_lines_zhou<std::uint16_t>(ImageView16, const DerivativeKernels&, const RidgeLimits&,
                                             double, WholeImageWorkspace&, LineSet&);

}  // namespace lightstripe
