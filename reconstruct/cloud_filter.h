// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Thins a cloud and drops lone points, through PCL. Points that stay are as they were measured, in their
// order.
#pragma once

#include <string>
#include <vector>

#include "reconstruct/cloud.h"

namespace lightstripe {

struct CloudFilter {
  bool outliers = false;
  int neighbours = 12;       ///< that a point's mean distance is taken to
  double outlier_sigma = 3;  ///< farther than the cloud's mean by so many standard deviations: dropped
  double voxel_mm = 0;       ///< one point stays in each cube of this size; 0: no thinning
};

/// "outliers,voxel=0.2" or "outliers=2.5": what is named is done, outliers first. An Error for other words.
CloudFilter parse_cloud_filter(const std::string& text);

/// Statistical outlier removal (Rusu 2008) and a voxel grid that keeps the point nearest to each voxel's
/// middle.
std::vector<CloudPoint> filter_cloud(std::vector<CloudPoint> points, const CloudFilter& filter);

}  // namespace lightstripe
