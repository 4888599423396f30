// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What the thickness of a laser sheet does to the size of a curved body.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/rig.h"

namespace lightstripe {

/// 1-sigma thickness of the sheet, mm, by the full width of its line where it meets a surface at `p_camera`
/// (camera frame, mm) that stands square to the sheet; less what a usual lens and its pixels blur. Nothing
/// where the camera looks along the plane's normal.
std::optional<double> sheet_sigma_mm(const Camera& camera, const Plane& plane,
                                     const Eigen::Vector3d& p_camera, double width_px);

/// Of sheet_error_mm(), what is left where the points lie in the sheet's middle (reconstruct/sheet_middle.h):
/// 0.4 to 0.6 for rendered balls of 40 mm under sheets of 0.4 to 1 mm.
inline constexpr double kLeftInTheMiddle = 0.6;

/// By about how much a sheet of this thickness makes the diameter of a round body too small whose points lie
/// in the middle of the stripe. A point of the picture at the distance d from the sheet's middle shows the
/// body d^2 / 2R deeper, and the light falls on it at another slant; where the surface leans along the travel
/// the sheet covers more of it. Summed over a matt ball seen at 40 degrees this is 8 t^2/R (5 to 11, by how
/// the surface scatters, the width of the kernels and the part that is seen). `axis`: of a cylinder, unit;
/// zero for a ball. Along its axis a cylinder is straight: what counts is its curvature across the sheet,
/// whose normal is `normal` (unit, the same frame).
double sheet_error_mm(double sheet_sigma_mm, double diameter_mm, const Eigen::Vector3d& axis,
                      const Eigen::Vector3d& normal);

}  // namespace lightstripe
