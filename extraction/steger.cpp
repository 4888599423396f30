// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/steger.h"

#include <opencv2/imgproc.hpp>

#include "extraction/link_points.h"

namespace lightstripe {
namespace {

/// One of the unshifted kernels as OpenCV wants it (correlation, odd length).
cv::Mat kernel_row(const DerivativeKernels& kernels, int order) {
  const float* weights = kernels.phase(0) + order * kernels.pitch;
  const int length = 2 * kernels.radius + 1;
  cv::Mat row(1, length, CV_32F);
  for (int i = 0; i < length; ++i) row.at<float>(i) = weights[i];
  return row;
}

cv::Mat filtered(const cv::Mat& image, const cv::Mat& kernel_x, const cv::Mat& kernel_y) {
  cv::Mat out;
  cv::sepFilter2D(image, out, CV_32F, kernel_x, kernel_y, cv::Point(-1, -1), 0, cv::BORDER_REPLICATE);
  return out;
}

template <class T>
cv::Mat as_mat(ImageView<T> image) {
  return {image.height, image.width, cv::DataType<T>::type, const_cast<T*>(image.data),
          static_cast<std::size_t>(image.stride) * sizeof(T)};
}

}  // namespace

template <class T>
void find_lines_steger(ImageView<T> image, const DerivativeKernels& kernels, const RidgeLimits& limits,
                       LineSet& lines) {
  const cv::Mat grey = as_mat(image);
  const cv::Mat smooth = kernel_row(kernels, 0), slope = kernel_row(kernels, 1),
                curvature = kernel_row(kernels, 2);
  const cv::Mat dx = filtered(grey, slope, smooth), dy = filtered(grey, smooth, slope);
  const cv::Mat dxx = filtered(grey, curvature, smooth), dyy = filtered(grey, smooth, curvature);
  const cv::Mat dxy = filtered(grey, slope, slope);
  LinePointMap map;
  map.reset(image.width, image.height);
  for (int y = 0; y < image.height; ++y) {
    const float *rx = dx.ptr<float>(y), *ry = dy.ptr<float>(y), *rxx = dxx.ptr<float>(y),
                *rxy = dxy.ptr<float>(y), *ryy = dyy.ptr<float>(y);
    for (int x = 0; x < image.width; ++x) {
      // The eigenvalue's magnitude is at most |rxx| + |rxy| + |ryy|: most of the image ends here.
      if (std::abs(rxx[x]) + std::abs(ryy[x]) + 2 * std::abs(rxy[x]) < limits.follow_strength) continue;
      if (limits.hard_levels && image(x, y) < limits.level_low) continue;
      map.test_pixel(x, y, {0, rx[x], ry[x], rxx[x], rxy[x], ryy[x]}, limits.follow_strength);
    }
  }
  link_points(map, limits.start_strength, lines);
  refine_points(image, kernels, lines);
}

template void find_lines_steger<std::uint8_t>(ImageView8, const DerivativeKernels&, const RidgeLimits&,
                                              LineSet&);
template void find_lines_steger<std::uint16_t>(ImageView16, const DerivativeKernels&, const RidgeLimits&,
                                               LineSet&);

}  // namespace lightstripe
