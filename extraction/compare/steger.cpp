// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/compare/steger.h"

#include <opencv2/imgproc.hpp>

namespace lightstripe {
namespace {

/// One of the unshifted kernels as OpenCV wants it (correlation, odd length).
cv::Mat kernel_row(const DerivativeKernels& kernels, int order) {
  const float* weights = kernels.phase(0) + static_cast<std::ptrdiff_t>(order) * kernels.pitch;
  const int length = 2 * kernels.radius + 1;
  cv::Mat row(1, length, CV_32F);
  for (int i = 0; i < length; ++i) row.at<float>(i) = weights[i];
  return row;
}

void filter(const cv::Mat& image, const cv::Mat& kernel_x, const cv::Mat& kernel_y, Image<float>& plane) {
  plane.width = image.cols;
  plane.height = image.rows;
  plane.pixels.resize(static_cast<std::size_t>(image.cols) * static_cast<std::size_t>(image.rows));
  cv::Mat out(image.rows, image.cols, CV_32F, plane.pixels.data());
  cv::sepFilter2D(image, out, CV_32F, kernel_x, kernel_y, cv::Point(-1, -1), 0, cv::BORDER_REPLICATE);
}

template <class T>
cv::Mat as_mat(ImageView<T> image) {
  return {image.height, image.width, cv::DataType<T>::type, const_cast<T*>(image.data),
          static_cast<std::size_t>(image.stride) * sizeof(T)};
}

}  // namespace

template <class T>
void find_lines_steger(ImageView<T> image, const DerivativeKernels& kernels, const RidgeLimits& limits,
                       WholeImageWorkspace& workspace, LineSet& lines) {
  const cv::Mat grey = as_mat(image);
  const cv::Mat smooth = kernel_row(kernels, 0), slope = kernel_row(kernels, 1),
                curvature = kernel_row(kernels, 2);
  DerivativePlanes& planes = workspace.planes;
  filter(grey, slope, smooth, planes.dx);
  filter(grey, smooth, slope, planes.dy);
  filter(grey, curvature, smooth, planes.dxx);
  filter(grey, slope, slope, planes.dxy);
  filter(grey, smooth, curvature, planes.dyy);
  find_lines_in_planes(image, kernels, limits, workspace, lines);
}

template void find_lines_steger<std::uint8_t>(ImageView8, const DerivativeKernels&, const RidgeLimits&,
                                              WholeImageWorkspace&, LineSet&);
template void find_lines_steger<std::uint16_t>(ImageView16, const DerivativeKernels&, const RidgeLimits&,
                                               WholeImageWorkspace&, LineSet&);

}  // namespace lightstripe
