// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "truth/bench_references.h"

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace lightstripe {
namespace {

cv::Mat as_mat(ImageView8 image) {
  return cv::Mat(image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.data),
                 static_cast<std::size_t>(image.stride));
}

/// The Gaussian's derivatives of order 0..2, averaged over each pixel: differences of the next lower one at
/// the pixel's ends.
cv::Mat1f gaussian_kernel(double sigma, int order) {
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  const auto lower = [&](double x) {
    const double gauss = std::exp(-x * x / (2 * sigma * sigma)) / (std::sqrt(2 * std::numbers::pi) * sigma);
    return order == 0   ? 0.5 * std::erf(x / (std::numbers::sqrt2 * sigma))
           : order == 1 ? gauss
                        : -x / (sigma * sigma) * gauss;
  };
  cv::Mat1f kernel(2 * radius + 1, 1);
  // sepFilter2D correlates: the mirrored kernel makes it the convolution that a derivative is.
  for (int i = -radius; i <= radius; ++i)
    kernel(radius - i, 0) = static_cast<float>(lower(i + 0.5) - lower(i - 0.5));
  return kernel;
}

struct Ridge {
  float eigenvalue, nx, ny;
};

/// Eigenvalue of largest magnitude of the Hessian and its unit vector.
Ridge ridge_of(float xx, float xy, float yy) {
  const float half = 0.5F * (xx - yy), root = std::sqrt(half * half + xy * xy), mean = 0.5F * (xx + yy);
  const float eigenvalue = mean < 0 ? mean - root : mean + root;
  float nx = eigenvalue - yy, ny = xy;
  if (std::abs(nx) < std::abs(eigenvalue - xx)) nx = xy, ny = eigenvalue - xx;
  const float length = std::hypot(nx, ny);
  return length > 0 ? Ridge{eigenvalue, nx / length, ny / length} : Ridge{eigenvalue, 1.0F, 0.0F};
}

}  // namespace

const std::vector<StripePoint>& steger_by_opencv(ImageView8 image, double sigma, double min_strength,
                                                 OpenCvSteger& kept) {
  const cv::Mat source = as_mat(image);
  const cv::Mat1f g0 = gaussian_kernel(sigma, 0), g1 = gaussian_kernel(sigma, 1),
                  g2 = gaussian_kernel(sigma, 2);
  const auto filter = [&](std::size_t plane, const cv::Mat1f& kx, const cv::Mat1f& ky) {
    Image<float>& out = kept.planes.at(plane);
    if (out.width != image.width || out.height != image.height) out = Image<float>(image.width, image.height);
    cv::Mat1f target(out.height, out.width, out.pixels.data());
    cv::sepFilter2D(source, target, CV_32F, kx, ky, cv::Point(-1, -1), 0, cv::BORDER_REPLICATE);
    return target;
  };
  const cv::Mat1f x = filter(0, g1, g0), y = filter(1, g0, g1), xx = filter(2, g2, g0),
                  xy = filter(3, g1, g1), yy = filter(4, g0, g2);
  std::vector<StripePoint>& points = kept.points;
  points.clear();
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      const Ridge ridge = ridge_of(xx(row, column), xy(row, column), yy(row, column));
      if (ridge.eigenvalue > -static_cast<float>(min_strength)) continue;
      const float t = -(x(row, column) * ridge.nx + y(row, column) * ridge.ny) / ridge.eigenvalue;
      const float dx = t * ridge.nx, dy = t * ridge.ny;
      if (std::abs(dx) > 0.5F || std::abs(dy) > 0.5F) continue;
      StripePoint point;
      point.x = column + static_cast<double>(dx);
      point.y = row + static_cast<double>(dy);
      point.normal_x = ridge.nx;
      point.normal_y = ridge.ny;
      point.strength = -ridge.eigenvalue;
      points.push_back(point);
    }
  }
  return points;
}

void calchist_by_opencv(ImageView8 image) {
  const cv::Mat source = as_mat(image);
  cv::Mat histogram;
  const int channels[] = {0}, sizes[] = {256};
  const float range[] = {0, 256};
  const float* ranges[] = {range};
  cv::calcHist(&source, 1, channels, cv::Mat(), histogram, 1, sizes, ranges);
}

void gaussianblur_by_opencv(ImageView8 image, double sigma, Image8& out) {
  if (out.width != image.width || out.height != image.height) out = Image8(image.width, image.height);
  cv::Mat target(out.height, out.width, CV_8UC1, out.pixels.data());
  cv::GaussianBlur(as_mat(image), target, cv::Size(), sigma, sigma, cv::BORDER_REPLICATE);
}

}  // namespace lightstripe
