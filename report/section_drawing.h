// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A section laid on its reference as things to draw: shared by the report (SVG) and the plot (PNG).
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "measure/measure_profile.h"
#include "pipeline/measure_job.h"
#include "report/preview.h"

namespace lightstripe {

struct SectionDrawing {
  std::vector<std::vector<Eigen::Vector2d>> reference;  ///< polylines, mm
  std::vector<Eigen::Vector2d> points;                  ///< measured, on the reference
  struct Whisker {
    Eigen::Vector2d foot, end;  ///< from the reference outwards, the difference enlarged
    double difference = 0;      ///< mm, + outside
  };
  std::vector<Whisker> whiskers;
  double enlarged = 10;
  Eigen::Vector2d low = Eigen::Vector2d::Zero(), high = Eigen::Vector2d::Zero();  ///< what to show
};

/// Empty points where the section is not registered.
SectionDrawing draw_section(const Profile& profile, const Registration& registration,
                            const ReferenceShape& reference);

/// As an <svg> element of this width.
std::string section_svg(const SectionDrawing& drawing, int width_px);

/// As a picture with its figures below.
RgbPicture section_picture(const SectionDrawing& drawing, const MeasuredFrame& row, int width_px = 1400);

/// The section of a frame on its reference, with its figures; an Error where the sections have no such frame.
RgbPicture plot_frame(const MeasureResult& result, std::int64_t frame);

}  // namespace lightstripe
