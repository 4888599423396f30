// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Real recordings: Sd, Sh and qR recomputed from the points against what the device wrote into their headers.
#include <gtest/gtest.h>

#include <fstream>

#include "io/nominal_outlines.h"
#include "measure/measure_wheel.h"
#include "measure/profile_formats.h"
#include "test_paths.h"

namespace lightstripe {
namespace {

const std::string kFolder = std::string(LIGHTSTRIPE_SOURCE_DIR) + "/../shared/data/miniprof/";

RecordedProfile read(const std::string& name, ObjectKind kind) {
  std::ifstream in(kFolder + name);
  return *profile_format(name) == ProfileFormat::kMiniProf ? read_miniprof(in, name, kind)
                                                           : read_simpack(in, name);
}

class MiniProf : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::ifstream(kFolder + "avg_HR.BAN")) GTEST_SKIP() << "recordings not present";
  }
};

// 0.05 mm: the header's figures come from the device's own interpolation and flange-back datum; an
// independent recomputation of the same files found 0.02 to 0.03.
TEST_F(MiniProf, WheelFiguresAreTheDevices) {
  const ReferenceShape reference("S1002", ObjectKind::kWheel, read_nominal("S1002"));
  for (const char* name : {"left-wheel-v1-pre-dry.whl", "whl_left_iter288.whl"}) {
    const RecordedProfile recorded = read(name, ObjectKind::kWheel);
    const Section section = section_of(recorded);
    const Registration registration = register_section(section, reference, {.pose = SectionPose{}});
    const WheelMeasurement wheel = measure_wheel(section, reference, registration, {.back_is_given = true});
    ASSERT_TRUE(wheel.flange_thickness.value && wheel.flange_height.value && wheel.qr.value) << name;
    EXPECT_NEAR(*wheel.flange_thickness.value, *recorded.number("Sd"), 0.05) << name;
    EXPECT_NEAR(*wheel.flange_height.value, *recorded.number("Sh"), 0.05) << name;
    EXPECT_NEAR(*wheel.qr.value, *recorded.number("qR"), 0.05) << name;
    EXPECT_LT(*wheel.flange_thickness.sigma, 0.05)
        << name;  // that it is no S1002 is no error of the measurement
  }
}

TEST_F(MiniProf, RailsStandUpright) {
  for (const char* name : {"avg_HR.BAN", "left-roller-v1-pre-dry.ban", "site_b_hr.prr"}) {
    const RecordedProfile rail = read(name, ObjectKind::kRail);
    double top = -1e9, where = 0;
    for (const auto& p : rail.points)
      if (p.y() > top) top = p.y(), where = p.x();
    EXPECT_LT(std::abs(where), 25) << name;
    EXPECT_LT(rail.points.back().y(), top - 4) << name;
  }
}

TEST_F(MiniProf, ASimpackWheelHasItsFlangeUp) {
  const RecordedProfile wheel = read("worn_high_mileage.prw", ObjectKind::kWheel);
  EXPECT_EQ(wheel.kind, ObjectKind::kWheel);
  double top = -1e9, where = 0;
  for (const auto& p : wheel.points)
    if (p.y() > top) top = p.y(), where = p.x();
  EXPECT_GT(top, 20);
  EXPECT_LT(where, -40);
}

}  // namespace
}  // namespace lightstripe
