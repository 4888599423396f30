// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What the extraction is timed against: the same work put together from OpenCV's building blocks.
#pragma once

#include <array>
#include <vector>

#include "core/image.h"
#include "core/stripe.h"

namespace lightstripe {

/// What a caller keeps from picture to picture, as ours keep their workspace.
struct OpenCvSteger {
  std::array<Image<float>, 5> planes;
  std::vector<StripePoint> points;
};

/// Steger's test at every pixel: five cv::sepFilter2D with kernels integrated over the pixel and the
/// eigenvalue test, in single precision. Points where the Hessian's eigenvalue of largest magnitude is below
/// -min_strength; valid until the next call with the same `kept`. With new planes for each picture
/// most of the time can be page faults: 12 ms became 46 on one machine.
const std::vector<StripePoint>& steger_by_opencv(ImageView8 image, double sigma, double min_strength,
                                                 OpenCvSteger& kept);

void calchist_by_opencv(ImageView8 image);
void gaussianblur_by_opencv(ImageView8 image, double sigma, Image8& out);

}  // namespace lightstripe
