// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Features that a user names in a section (lines, arcs, points), and what is measured between them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/profile.h"
#include "measure/estimate.h"
#include "measure/feature_file.h"
#include "measure/feature_fit.h"

namespace lightstripe {

/// One section's features by the order of the file, and its quantities.
struct MeasuredFeatures {
  std::int64_t frame = 0;
  double travel = 0;
  std::vector<ShapeFit> features;  ///< intersections and knees as points
  std::vector<Estimate> quantities;
  std::string verdict;  ///< pass, fail, unknown; empty without limits
};

/// Fits the features one after the other, then measures. The sigma is carried from each fit's covariance by
/// the derivatives of the quantity; fits of different features count as independent.
MeasuredFeatures measure_features(const Profile& profile, const FeatureFile& file);

/// Over all sections: peak to valley of a feature about its best plane (flatness), of a feature about its
/// best line (straightness; offsets across), of the distance of two lines (parallelism). Needs three
/// sections.
std::vector<Estimate> measure_along(const std::vector<MeasuredFeatures>& sections, const FeatureFile& file);

}  // namespace lightstripe
