// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The daily check with a body of known size, by the command line, on rendered scans with the true rig.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "command_line.h"
#include "io/atomic_file.h"
#include "io/csv_reader.h"
#include "io/rig_file.h"

namespace lightstripe {
namespace {

using ::testing::HasSubstr;

class ArtefactChecks : public ::testing::Test {
 protected:
  /// `objects`: YAML of the scene. One sensor with a thin sheet of light, no boards: seconds.
  void simulate(const std::string& objects, int frames, double thickness_sigma_mm = 0.2) {
    write_text(
        folder_ / "scene.yaml",
        "seed: 5\nboards: {count: 0}\nmotion: {positions: 2}\nreflections: {per_frame: 0}\nrail: {profile: "
        "none}\nimaging: {samples: 4}\nsensors: [{name: solo, laser: {thickness_sigma_mm: " +
            std::to_string(thickness_sigma_mm) + "}}]\nscan: {frames: " + std::to_string(frames) +
            ", step_mm: 2}\n" + objects);
    const auto made =
        run_lightstripe("simulate " + quoted(folder_ / "scene.yaml") + " -o " + quoted(folder_ / "s"));
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }
  CommandResult verify(const std::string& input, const std::string& options) const {
    return run_lightstripe("verify " + quoted(folder_ / input) + " --rig " + quoted(folder_ / rig_) + " -o " +
                           quoted(folder_ / "checks.csv") + " " + options);
  }
  /// error_mm, sigma_mm, drift_mm (0 where there is none) of each row.
  std::vector<std::array<double, 3>> checks() const {
    std::vector<std::array<double, 3>> all;
    CsvReader rows(folder_ / "checks.csv", {"error_mm", "sigma_mm", "drift_mm"});
    while (rows.next())
      all.push_back({rows.number(0), rows.number(1), rows.text(2).empty() ? 0 : rows.number(2)});
    return all;
  }

  TemporaryFolder folder_;
  std::string rig_ = "s/truth/rig.yaml";
};

TEST_F(ArtefactChecks, ABallPassesAndADriftIsTold) {
  simulate("spheres: [{center: [0, 5, -75], radius_mm: 20}]\nground: {height_mm: -95}\n", 28);
  const auto first = verify("s/scan.yaml", "--artefact sphere --size 40 --max-error-mm 0.1");
  ASSERT_EQ(first.exit_code, 0) << first.out << first.err;
  EXPECT_THAT(first.out, HasSubstr("sphere of 40 mm: measured"));
  // The camera's focal length is now 1 % off: the ball is as well.
  Rig rig = read_rig(folder_ / rig_);
  rig.sensors[0].camera.fx *= 1.01, rig.sensors[0].camera.fy *= 1.01;
  rig_ = "knocked.yaml";
  write_file(folder_ / rig_, rig_to_yaml(rig));
  const auto second = verify("s/scan.yaml", "--artefact sphere --size 40 --max-error-mm 0.1 --report " +
                                                quoted(folder_ / "checks.html"));
  EXPECT_EQ(second.exit_code, 3) << second.out;
  EXPECT_THAT(second.err, HasSubstr("more than the allowed 0.1"));
  EXPECT_THAT(second.out, HasSubstr("it drifts"));
  const auto rows = checks();
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_LT(std::abs(rows[0][0]), 0.1);
  EXPECT_LT(rows[0][1], 0.1);
  EXPECT_GT(std::abs(rows[1][0]), 0.1);
  EXPECT_NEAR(rows[1][2], rows[1][0] - rows[0][0], 2e-5);
  const std::string page = read_file(folder_ / "checks.html");
  EXPECT_THAT(page, HasSubstr("Checks with the sphere of 40 mm"));
  EXPECT_THAT(page, HasSubstr("Error of the size"));
}

// The sheet lights the ball before and behind its middle: it comes out 0.07 mm small (0.15 if the stripe's
// middle is taken for the sheet's), and sigma says so.
TEST_F(ArtefactChecks, AThickSheetsErrorCountsInTheSigmaOfABall) {
  simulate("spheres: [{center: [0, 5, -75], radius_mm: 20}]\nground: {height_mm: -95}\n", 28, 0.6);
  const auto thick = verify("s/scan.yaml", "--artefact sphere --size 40");
  EXPECT_EQ(thick.exit_code, 0) << thick.out << thick.err;
  EXPECT_THAT(thick.out, HasSubstr("makes the body smaller by about 0."));
  EXPECT_LT(std::abs(checks()[0][0]), 1.5 * checks()[0][1]);
  EXPECT_LT(std::abs(checks()[0][0]), 0.1);
  EXPECT_LT(checks()[0][1], 0.15);
}

TEST_F(ArtefactChecks, StepAndCylinderByAScanAndByOnePicture) {
  simulate("steps: [{base: [0, 5, -95], heights_mm: [30, 10], run_mm: 30}]\n", 6);
  for (const std::string input : {"s/scan.yaml", "s/scan/solo/0003.png"}) {
    const auto done = verify(input, "--artefact step --size 20 --max-error-mm 0.05");
    EXPECT_EQ(done.exit_code, 0) << input << done.out << done.err;
  }
  simulate("cylinders: [{center: [0, 5, -75], axis: [1, 0.1, 0], radius_mm: 20}]\nground: {height_mm: -95}\n",
           12);
  const auto scan = verify("s/scan.yaml", "--artefact cylinder --size 40 --max-error-mm 0.1");
  EXPECT_EQ(scan.exit_code, 0) << scan.out << scan.err;
}

TEST_F(ArtefactChecks, WhatCannotBeJudgedIsSaid) {
  simulate("ground: {height_mm: -80}\n", 6);
  const auto none = verify("s/scan.yaml", "--artefact sphere --size 40");
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_THAT(none.err, HasSubstr("no sphere of about 40 mm diameter is in the points"));
  const auto picture = verify("s/scan/solo/0003.png", "--artefact sphere --size 40");
  EXPECT_EQ(picture.exit_code, 1);
  EXPECT_THAT(picture.err, HasSubstr("one picture shows a circle of the ball"));
  const auto no_size = verify("s/scan.yaml", "--artefact step");
  EXPECT_EQ(no_size.exit_code, 1);
  EXPECT_THAT(no_size.err, HasSubstr("error: --size: the body's size is not given"));
}

}  // namespace
}  // namespace lightstripe
