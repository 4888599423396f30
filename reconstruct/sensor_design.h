// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What a camera and a laser plane can measure before anything is bought: range, resolution, noise.
#pragma once

#include "core/rig.h"

namespace lightstripe {

/// The optical axis meets the laser plane at `distance_mm` under `angle_deg` (the triangulation angle,
/// between the axis and the plane). The image's columns lie along the stripe, its rows across it.
struct SensorDesign {
  double distance_mm = 550;
  double angle_deg = 40;
  double focal_px = 1640;
  int along_px = 960, across_px = 700;  ///< size of the image along and across the stripe
  double noise_px = 0.05;               ///< error of the stripe across itself, 1 sigma
};

/// At one depth of the measuring range.
struct DesignPlace {
  double height_mm = 0;     ///< within the laser plane, from where the axis meets it; + towards the camera
  double width_mm = 0;      ///< that the image covers along the stripe
  double along_mm_px = 0;   ///< along the stripe, mm a pixel
  double across_mm_px = 0;  ///< height, mm a pixel
  double sigma_mm = 0;      ///< of the height, 1 sigma, for noise_px
};

struct DesignAnswer {
  DesignPlace near, middle, far;
  double range_mm = 0;  ///< from far to near; infinite where the far end of the image never meets the plane
};

/// By the pinhole: a point of the plane at height h is seen at f h sin(a) / (D - h cos(a)) across the image,
/// of which height and noise follow. The lens' distortion is left out. An Error for values that make no
/// sensor.
DesignAnswer design_sensor(const SensorDesign& design);

/// The same sensor as a rig, for those who want to compute more: the rig frame's x is the plane's normal, the
/// stripe runs along y.
Rig rig_of_design(const SensorDesign& design);

}  // namespace lightstripe
