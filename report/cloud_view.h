// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// cloud.html: one page that shows a cloud: turn it, colour it, click points, measure between two of them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "pipeline/frame_links.h"
#include "reconstruct/cloud.h"

namespace lightstripe {

/// Of `total` points in turn keeps at most `max_points`, one of each run of equal length, at a place in the
/// run that is drawn with a fixed seed (stratified sampling): even, without a pattern of its own.
class EvenThinning {
 public:
  EvenThinning(std::int64_t total, std::int64_t max_points);
  bool keep();

 private:
  std::int64_t total_, kept_max_;
  std::int64_t next_ = 0, run_ = 0, chosen_ = 0;
};

/// What a browser carries: 1.2 million points make a page of about 27 MB.
inline constexpr std::int64_t kMaxViewPoints = 1'200'000;

struct CloudView {
  std::string title;
  std::vector<std::string> sensors;                  ///< names; empty: by index
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< what the points count from, mm; the page adds it
  std::int64_t total = 0;                            ///< points of the whole cloud
  std::vector<CloudPoint> points;                    ///< shown, in the order of their frames
  std::vector<float> deviation_mm;  ///< from the nominal, + outside, NaN unknown; empty: none given
  std::string nominal;              ///< what the deviation is from
  std::map<std::int64_t, std::vector<FrameLink>> links;  ///< pictures of the frames shown
};

/// Deviations of the points of one frame, as CloudView::deviation_mm.
using FrameDeviation = std::function<std::vector<float>(const std::vector<CloudPoint>&)>;

/// The file, thinned. `deviation` may be empty.
CloudView view_of_cloud(const std::filesystem::path& cloud, const FrameDeviation& deviation = {},
                        std::int64_t max_points = kMaxViewPoints);

/// The numbers of the frames that are shown, each once.
std::vector<std::int64_t> frames_shown(const CloudView& view);

/// The page. Coordinates keep 24 bits of the cloud's extent (0.6 um of 10 m).
std::string cloud_view_html(const CloudView& view);

}  // namespace lightstripe
