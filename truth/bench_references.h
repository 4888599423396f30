// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What the extraction is timed against: the same work put together from OpenCV's building blocks.
#pragma once

#include <vector>

#include "core/image.h"
#include "core/stripe.h"

namespace lightstripe {

/// Steger's test at every pixel: five cv::sepFilter2D with kernels integrated over the pixel and the
/// eigenvalue test, in single precision. Points where the Hessian's eigenvalue of largest magnitude is below
/// -min_strength.
std::vector<StripePoint> steger_by_opencv(ImageView8 image, double sigma, double min_strength);

void calchist_by_opencv(ImageView8 image);
void gaussianblur_by_opencv(ImageView8 image, double sigma, Image8& out);

}  // namespace lightstripe
