// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0

#include <array>
#include <cmath>

#include "calib/assess/diagnosis.h"
#include "calib/assess/uncertainty.h"
#include "parallel/parallel.h"

namespace lightstripe {
namespace {

constexpr int kMinViewsOfHalf =
    5;  // of a sensor in a half: fewer say more about their number than about the model

/// Every other pose, and every other position of the travelling board.
SessionViews half_of(const SessionViews& all, int half) {
  SessionViews result = all;
  result.views.clear();
  int position = 0;
  for (const auto& view : all.views) {
    const int number = view.pose >= 0 ? view.pose : position++;
    if (number % 2 == half) result.views.push_back(view);
  }
  return result;
}

/// Empty where every sensor has enough views, and the motion its two positions.
std::string too_small(const SessionViews& half) {
  std::vector<int> count(half.sensor_names.size(), 0);
  int positions = 0;
  for (const auto& view : half.views) {
    if (view.pose < 0)
      ++positions;
    else
      ++count[static_cast<std::size_t>(view.sensor)];
  }
  for (std::size_t s = 0; s < count.size(); ++s)
    if (count[s] < kMinViewsOfHalf) return "sensor " + half.sensor_names[s] + " has fewer than 10 views";
  if (half.motion != MotionType::kNone && positions < 2) return "the motion has fewer than 4 views";
  return {};
}

}  // namespace

CrossValidation cross_validate(const SessionViews& session, const JointAdjustment& adjustment,
                               const Eigen::Vector3d& up, const CalibrationOptions& options) {
  CrossValidation result;
  const std::array<SessionViews, 2> halves{half_of(session, 0), half_of(session, 1)};
  result.why_not = too_small(halves[0]).empty() ? too_small(halves[1]) : too_small(halves[0]);
  const auto samples = section_samples(session, adjustment.residuals);
  if (samples.size() < 3) result.why_not = "no stripes";
  if (!result.why_not.empty()) return result;
  std::array<JointAdjustment, 2> adjusted;
  const auto adjust_half = [&](std::size_t i) {
    adjusted[i] = adjust_jointly(halves[i], adjustment.state, adjustment.lenses, options);
  };
  parallel_for(2, adjust_half);
  for (const auto& half : adjusted) {
    if (half.converged && half.covariance.size() > 0) continue;
    result.why_not = "half of the views do not determine the rig";
    return result;
  }
  std::array<Eigen::VectorXd, 2> sections;
  for (std::size_t i = 0; i < 2; ++i)
    sections[i] = section_of(adjusted[i].state, session.motion, up, samples);
  double variance = 0;
  for (const auto& half : adjusted) {
    const Eigen::MatrixXd J = without_rigid_motion(sections[0], section_jacobian(session, half, up, samples));
    variance += (J * half.covariance).cwiseProduct(J).sum() / static_cast<double>(samples.size());
  }
  result.done = true;
  result.difference_mm = without_rigid_motion(sections[0], sections[1] - sections[0]).norm() /
                         std::sqrt(static_cast<double>(samples.size()));
  result.predicted_mm = std::sqrt(variance);
  return result;
}

}  // namespace lightstripe
