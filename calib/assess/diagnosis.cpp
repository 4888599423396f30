// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/assess/diagnosis.h"

#include <algorithm>
#include <array>

#include "calib/adjust/rig_frame.h"

namespace lightstripe {

std::vector<ResidualSample> residual_samples(const SessionViews& session, const JointAdjustment& adjustment) {
  std::vector<ResidualSample> samples;
  samples.reserve(adjustment.residuals.size());
  for (const auto& m : adjustment.residuals) {
    const auto& view = session.views[m.view];
    ResidualSample sample{static_cast<int>(m.view), m.is_corner(), m.used, {}, m.residual_px, m.normalised()};
    if (m.is_corner()) {
      sample.pixel = view.corners[m.index];
    } else {
      const auto& point = view.stripes[static_cast<std::size_t>(m.plane)][m.index];
      sample.pixel = {point.x, point.y};
    }
    samples.push_back(sample);
  }
  return samples;
}

std::vector<double> corner_coverage(const SessionViews& session, const JointAdjustment& adjustment) {
  constexpr int kColumns = 8, kRows = 6;
  constexpr std::size_t kCells = std::size_t{kColumns} * kRows;
  std::vector<std::array<bool, kCells>> hit(session.sensor_names.size());
  for (const auto& m : adjustment.residuals) {
    if (!m.is_corner() || !m.used) continue;
    const auto s = static_cast<std::size_t>(session.views[m.view].sensor);
    const auto& size = session.image_sizes[s];
    const auto& q = session.views[m.view].corners[m.index];
    const int x = std::clamp(static_cast<int>(kColumns * q.x() / size[0]), 0, kColumns - 1);
    const int y = std::clamp(static_cast<int>(kRows * q.y() / size[1]), 0, kRows - 1);
    hit[s][static_cast<std::size_t>(y * kColumns + x)] = true;
  }
  std::vector<double> shares;
  for (const auto& grid : hit)
    shares.push_back(static_cast<double>(std::count(grid.begin(), grid.end(), true)) / kCells);
  return shares;
}

CalibrationDiagnosis diagnose(const SessionViews& session, const JointAdjustment& adjustment,
                              const std::vector<BoardSpread>& spreads, const SectionErrors& errors,
                              const Eigen::Vector3d& up, const CalibrationOptions& options) {
  CalibrationDiagnosis result;
  result.residuals = residual_samples(session, adjustment);
  result.map = uncertainty_map(session, adjustment, spreads, up, options.range_near_mm, options.range_far_mm);
  result.cross_validation = cross_validate(session, adjustment, up, options);
  result.weakest = weakest_direction(session, adjustment, spreads, errors, up);
  result.corner_coverage = corner_coverage(session, adjustment);
  const Rigid3 rig = rig_from_first(adjustment.state, session.motion, up);
  for (const auto& pose : adjustment.state.first_from_board) result.rig_from_board.push_back(rig * pose);
  result.pose_names = session.poses;
  return result;
}

}  // namespace lightstripe
