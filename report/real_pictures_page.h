// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// docs/real_pictures.md: how the methods do on labelled real pictures and on speckle, and what remains hard.
#pragma once

#include <string>
#include <vector>

#include "report/line_labels.h"

namespace lightstripe {

/// One method on one labelled picture.
struct MethodScore {
  std::string method, set, picture;
  LabelScore score;
  double median_ms = 0;
  double steger_ms = 0;  ///< of opencv-steger-kept on the same picture
};

/// A curved line of 480 rows under speckle, default options, over several pictures.
struct SpeckleScore {
  double contrast = 0, grain_px = 0, sigma_px = 0;  ///< sigma: the stripe's standard deviation
  double completeness = 0;
  std::int64_t false_points = 0;
  double rms_px = 0, smooth_rms_px = 0;                  ///< without and with smoothing
  double variance_ratio = 0, smooth_variance_ratio = 0;  ///< actual over predicted
};

/// The page, markdown. The first method's pictures are those that are told one by one. `cameras`: the default
/// method on imitated pictures, each with its camera's name as method.
std::string real_pictures_page(const std::vector<MethodScore>& scores,
                               const std::vector<MethodScore>& cameras,
                               const std::vector<SpeckleScore>& speckle);

}  // namespace lightstripe
