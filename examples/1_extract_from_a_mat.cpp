// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Finds the laser lines of a picture that OpenCV holds; the pixels are looked at where they are, not copied.
// usage: 1_extract_from_a_mat [PICTURE]
#include <cmath>
#include <cstdio>
#include <opencv2/imgcodecs.hpp>

#include "extraction/extract_stripes.h"

namespace {

/// A slightly slanted bar of light, where no picture is given.
cv::Mat drawn_stripe() {
  cv::Mat picture(300, 400, CV_8UC1);
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x) {
      const double across = y - (150.4 + 0.05 * x);
      picture.at<std::uint8_t>(y, x) =
          cv::saturate_cast<std::uint8_t>(20 + 180 * std::exp(-across * across / 8));
    }
  return picture;
}

}  // namespace

int main(int argc, char** argv) {
  const cv::Mat picture = argc > 1 ? cv::imread(argv[1], cv::IMREAD_GRAYSCALE) : drawn_stripe();
  if (picture.empty()) return 1;

  const lightstripe::ImageView8 view{picture.data, picture.cols, picture.rows,
                                     static_cast<std::ptrdiff_t>(picture.step1())};
  lightstripe::ExtractionOptions options;  // the width of the line is estimated from the picture
  const lightstripe::ExtractionResult result = lightstripe::extract_stripes(view, options);

  std::printf("%zu line%s\n", result.stripes.size(), result.stripes.size() == 1 ? "" : "s");
  for (const lightstripe::Stripe& stripe : result.stripes) {
    const lightstripe::StripePoint& first = stripe.points.front();
    std::printf("%zu points, the first at x = %.2f, y = %.2f px +- %.3f px\n", stripe.points.size(), first.x,
                first.y, first.sigma_px);
  }
}
