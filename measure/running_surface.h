// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The part of a wheel's or a rail's profile that rolls: noise smoothed out, as heights over the lateral
// coordinate.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/random.h"

namespace lightstripe {

/// Heights on an even grid, read by cubic interpolation. mm; y grows from the flange or the gauge side (-) to
/// the field side (+); z up. A wheel's heights are those of its surface in the track: the flange hangs down.
struct HeightTable {
  double first_mm = 0, step_mm = 0.1;
  std::vector<double> height_mm;

  double last_mm() const { return first_mm + step_mm * static_cast<double>(height_mm.size() - 1); }
  /// Between the second and the last but one node; outside, the nearest of these cubics goes on.
  double at(double y) const;
  double slope_at(double y) const;
};

/// How a measured profile becomes a table.
struct SmoothingOptions {
  std::optional<double> sigma_mm;  ///< of a point; nothing: told from the points' third differences
  double correlation_mm = 0;       ///< length along the profile over which points share their error; 0: none
  double step_mm = 0.1;            ///< of the table
};

/// A smoothed profile and what its noise does to it.
class RunningSurface {
 public:
  /// Exact: an outline's points as they are, without noise.
  static RunningSurface exact(const std::vector<Eigen::Vector2d>& points, double step_mm = 0.1);
  /// `points` in their order along the profile, (y, z); at least eight. A smoothing spline over the arc
  /// length (penalty on the third derivative), stiff where the curvature is even and soft in corners: its
  /// strength falls with the square of the local third derivative; overall it follows Mallows' criterion for
  /// the points' sigma (Mallows 1973, Some comments on Cp).
  static RunningSurface measured(const std::vector<Eigen::Vector2d>& points, const SmoothingOptions& options);

  const HeightTable& table() const { return table_; }
  double sigma_mm() const { return sigma_mm_; }  ///< of a point, across the surface
  /// The table as another measurement with the same noise would give it, smoothed anew: how strongly was
  /// chosen by the noise, too.
  HeightTable redrawn(Random& random) const;

 private:
  HeightTable table_;
  double sigma_mm_ = 0;
  double correlation_mm_ = 0;
  std::vector<Eigen::Vector2d> curve_;  ///< the smooth profile at the points' places
  std::vector<double> arc_mm_;          ///< along it
  double factor_ = 0;                   ///< of the smoothing's strength
};

}  // namespace lightstripe
