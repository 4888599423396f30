// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/adjust/lens_model.h"

namespace lightstripe {

std::vector<int> free_terms(LensModel model) {
  switch (model) {
    case LensModel::kBrown4:
      return {0, 1, 2, 3};
    case LensModel::kBrown5:
      return {0, 1, 2, 3, 4};
    case LensModel::kRational:
      return {0, 1, 2, 3, 4, 5, 6, 7};
    case LensModel::kThinPrism:
      return {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
    case LensModel::kTilted:
      return {0, 1, 12, 13};
    case LensModel::kTilted5:
      return {0, 1, 4, 12, 13};
    case LensModel::kTiltedRational:
      return {0, 1, 4, 5, 6, 7, 12, 13};
    case LensModel::kPinhole:
    case LensModel::kAuto:
      break;
  }
  return {};
}

bool has_tilt(LensModel model) {
  return model == LensModel::kTilted || model == LensModel::kTilted5 || model == LensModel::kTiltedRational;
}

}  // namespace lightstripe
