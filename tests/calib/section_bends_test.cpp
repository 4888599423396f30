// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "core/section_bends.h"

#include <gtest/gtest.h>

#include "calib/calibrate_rig.h"
#include "section_error.h"

namespace lightstripe {
namespace {

using testing::observe;
using testing::rail_rig;
using testing::state_of;

/// Displacement of every sample by a rig's bend, (y, z) one after the other.
Eigen::VectorXd displaced(const SectionBends& bends, std::size_t bend, const Eigen::VectorXd& section,
                          const std::vector<SectionSample>& samples) {
  Eigen::VectorXd out(section.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto row = 2 * static_cast<Eigen::Index>(i);
    out.segment<2>(row) = displacement(bends, bend, samples[i].sensor, section(row), section(row + 1));
  }
  return out;
}

// Repeats of a calibration against what the bends say of each: the height of the section's upper end over the
// rest, which is what wear is measured by, and the length of all displacements. 30 repeats know a variance to
// 26 %; bends scaled by 0.7 or 1.4 change it by a factor of 2.
TEST(SectionBends, AreWhatCalibrationsErrBy) {
  constexpr int kRepeats = 30;
  const auto truth = rail_rig(2, 4);
  const Eigen::Vector3d up(0, -1, 0);
  CalibrationOptions options;
  options.lens = LensModel::kBrown4;
  double height = 0, predicted_height = 0, shape = 0, predicted_shape = 0;
  for (int i = 0; i < kRepeats; ++i) {
    const auto observations = observe(truth, {.seed = static_cast<std::uint64_t>(100 + i)});
    const auto result = calibrate_rig(observations, options);
    ASSERT_TRUE(result.summary.usable) << result.summary.message;
    ASSERT_TRUE(result.rig.quality.section_bends);
    const auto samples = testing::samples_of(truth, observations);
    const Eigen::VectorXd known = section_of(testing::state_of(truth), MotionType::kLinear, up, samples),
                          found = section_of(state_of(result.rig), MotionType::kLinear, up, samples);
    double highest = -1e9;
    for (Eigen::Index k = 1; k < known.size(); k += 2) highest = std::max(highest, known(k));
    Eigen::VectorXd upper_end = Eigen::VectorXd::Zero(known.size());
    for (Eigen::Index k = 1; k < known.size(); k += 2) upper_end(k) = known(k) > highest - 20 ? 1 : 0;
    upper_end = without_rigid_motion(known, upper_end / upper_end.sum());
    height += std::pow(upper_end.dot(found - known), 2);
    shape += without_rigid_motion(known, found - known).squaredNorm();
    for (std::size_t b = 0; b < result.rig.quality.section_bends->bends.size(); ++b) {
      const Eigen::VectorXd by = displaced(*result.rig.quality.section_bends, b, found, samples);
      predicted_height += std::pow(upper_end.dot(by), 2);
      predicted_shape += by.squaredNorm();
    }
  }
  RecordProperty("height", std::to_string(height / predicted_height));
  RecordProperty("shape", std::to_string(shape / predicted_shape));
  EXPECT_GT(height / predicted_height, 0.6);
  EXPECT_LT(height / predicted_height, 1.6);
  EXPECT_GT(shape / predicted_shape, 0.6);
  EXPECT_LT(shape / predicted_shape, 1.6);
}

}  // namespace
}  // namespace lightstripe
