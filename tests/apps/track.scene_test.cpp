// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// From pictures of both rails of a track to gauge and conicity: four sensors, a left rail that loses its
// gauge face. The rig is the true one, since no board is seen by all four sensors.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "command_line.h"
#include "io/csv_reader.h"
#include "io/rig_file.h"

namespace lightstripe {
namespace {

using ::testing::HasSubstr;
using Points = std::vector<std::pair<double, double>>;

std::map<std::int64_t, Points> sections_of(const std::filesystem::path& file) {
  std::map<std::int64_t, Points> out;
  CsvReader rows(file, {"frame", "u", "v"});
  while (rows.next()) out[rows.integer(0)].emplace_back(rows.number(1), rows.number(2));
  return out;
}

double top_of(const Points& points) {
  double top = -1e300;
  for (const auto& [u, v] : points) top = std::max(top, v);
  return top;
}

/// The innermost place (least `outwards` u) from the top down to 14 mm below it.
double face_of(const Points& points, double outwards) {
  const double level = top_of(points) - 14;
  double face = 1e300;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& [u, v] = points[i];
    const auto& [next_u, next_v] = points[(i + 1) % points.size()];
    if (v >= level) face = std::min(face, outwards * u);
    if ((v - level) * (next_v - level) < 0)
      face = std::min(face, outwards * (u + (level - v) / (next_v - v) * (next_u - u)));
  }
  return face;
}

/// The head as `conicity --rail` reads it.
std::string head_csv(const Points& points, double outwards) {
  const double top = top_of(points), face = face_of(points, outwards);
  Points head;
  for (const auto& [u, v] : points)
    if (v > top - 20) head.emplace_back(outwards * u - face - 36, v - top);
  std::sort(head.begin(), head.end());
  std::string text = "y_mm,z_mm\n";
  for (const auto& [y, z] : head) text += fmt::format("{:.6f},{:.6f}\n", y, z);
  return text;
}

class Track : public ::testing::Test {
 protected:
  static constexpr int kFrames = 4;
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    std::string scene = text_of(std::string(LIGHTSTRIPE_SOURCE_DIR) + "/configs/scenes/track.yaml");
    const std::string scan = "frames: 6, step_mm: 200";
    scene.replace(scene.find(scan), scan.size(), fmt::format("frames: {}, step_mm: 400", kFrames));
    write_text(*folder_ / "scene.yaml", scene);
    const std::string at = quoted(folder_->path());
    for (const std::string& command :
         {"simulate " + at + "/scene.yaml -o " + at + "/s",
          "reconstruct " + at + "/s/scan.yaml --rig " + at + "/s/truth/rig.yaml -o " + at +
              "/cloud.ply --profiles " + at + "/profiles.csv",
          "measure " + at + "/profiles.csv --kind rail --rails two --wheelset S1002 --conicity " + at +
              "/conicity.csv -o " + at + "/m.csv --report " + at +
              "/measure.html --limit.conicity-max 0.1"}) {
      const CommandResult result = run_lightstripe(command + " --quiet");
      ASSERT_EQ(result.exit_code, 0) << command << "\n" << result.err;
    }
  }
  static void TearDownTestSuite() { delete folder_; }
  static TemporaryFolder* folder_;
};
TemporaryFolder* Track::folder_ = nullptr;

TEST_F(Track, GaugeAndConicityAreThoseOfTheTrueSections) {
  const auto left = sections_of(*folder_ / "s/truth/sections.csv"),
             right = sections_of(*folder_ / "s/truth/other_sections.csv");
  CsvReader rows(*folder_ / "m.csv", {"frame", "gauge", "conicity", "conicity_sigma", "status"});
  int count = 0;
  while (rows.next()) {
    const Points &l = left.at(rows.integer(0)), &r = right.at(rows.integer(0));
    EXPECT_EQ(rows.text(4), "ok");
    const double gauge = face_of(l, 1) + face_of(r, -1);
    EXPECT_NEAR(rows.number(1), gauge, 0.02);  // 1435 to 1437.9
    write_text(*folder_ / "l.csv", head_csv(l, 1));
    write_text(*folder_ / "r.csv", head_csv(r, -1));
    const std::string at = quoted(folder_->path());
    ASSERT_EQ(run_lightstripe(fmt::format("conicity --wheel S1002 --rail {0}/l.csv --rail-right {0}/r.csv "
                                          "--rail-sigma 1e-5 --draws 0 --gauge {1} -o {0}/true.csv --quiet",
                                          at, gauge))
                  .exit_code,
              0);
    CsvReader truth(*folder_ / "true.csv", {"y_mm", "tan_gamma_e"});
    while (truth.next())
      if (std::abs(truth.number(0) - 3) < 1e-6) {
        EXPECT_NEAR(rows.number(2), truth.number(1), 0.008);  // 12 frames: 0.003 rms
        EXPECT_LT(std::abs(rows.number(2) - truth.number(1)), 3 * rows.number(3));
        ++count;
      }
  }
  EXPECT_EQ(count, kFrames);
}

TEST_F(Track, SecondRailsWearIsItsOwn) {
  CsvReader rows(*folder_ / "m.csv", {"frame", "side_wear", "right_side_wear", "right_vertical_wear"});
  while (rows.next()) {
    const double share = static_cast<double>(rows.integer(0)) / (kFrames - 1);
    EXPECT_NEAR(rows.number(1), 3 * share, 0.03);
    EXPECT_NEAR(rows.number(2), 0, 0.03);
    EXPECT_NEAR(rows.number(3), share, 0.03);
  }
}

TEST_F(Track, TableOfTheAmplitudesHasEverySection) {
  CsvReader rows(*folder_ / "conicity.csv",
                 {"frame", "travel", "gauge_mm", "y_mm", "delta_r_mm", "tan_gamma_e", "tan_gamma_e_sigma"});
  std::map<std::int64_t, int> count;
  while (rows.next()) ++count[rows.integer(0)];
  EXPECT_EQ(count.size(), static_cast<std::size_t>(kFrames));
  for (const auto& [frame, amplitudes] : count) EXPECT_GE(amplitudes, 40) << frame;
}

TEST_F(Track, LimitAndReportKnowTheConicity) {
  CsvReader rows(*folder_ / "m.csv", {"verdict"});
  while (rows.next()) EXPECT_EQ(rows.text(0), "fail");
  EXPECT_THAT(text_of(*folder_ / "measure.html"), HasSubstr("Equivalent conicity at 3 mm"));
}

// Both rails' places err by what the rig says; what the faces scatter by adds microns.
TEST_F(Track, GaugesSigmaIsTheRigs) {
  std::string rig = text_of(*folder_ / "s/truth/rig.yaml");
  const std::string unknown = "section_absolute_sigma_mm: 0\n";
  ASSERT_NE(rig.find(unknown), std::string::npos);
  rig.replace(rig.find(unknown), unknown.size(), "section_absolute_sigma_mm: 0.05\n");
  write_text(*folder_ / "rig.yaml", rig);
  const std::string at = quoted(folder_->path());
  ASSERT_EQ(
      run_lightstripe("measure " + at + "/profiles.csv --kind rail --rails two --wheelset S1002 --rig " + at +
                      "/rig.yaml -o " + at + "/g.csv --quiet")
          .exit_code,
      0);
  CsvReader rows(*folder_ / "g.csv", {"gauge_sigma", "conicity_sigma"});
  while (rows.next()) {
    EXPECT_NEAR(rows.number(0), std::sqrt(2.0) * 0.05, 0.01);
    EXPECT_GT(rows.number(1), 0.001);
  }
}

// A calibration that may shift the left rail's sensors sideways by 0.2 mm, and turn them by 0.2 mm in 100:
// the gauge errs by the first (and a little by the second), the conicity by both. The rig frame's origin is
// the first sensor: the left rail's head lies about (-308, -222).
TEST_F(Track, BendsOfTheRigCountInGaugeAndConicity) {
  Rig rig = read_rig(*folder_ / "s/truth/rig.yaml");
  SectionBends bends{{-308, -222}, 100, {std::vector<double>(48, 0.0), std::vector<double>(48, 0.0)}};
  for (const std::size_t sensor : {0, 1}) {
    bends.bends[0][12 * sensor] = 0.2;
    bends.bends[1][12 * sensor + 2] = -0.2, bends.bends[1][12 * sensor + 7] = 0.2;
  }
  rig.quality.section_bends = bends;
  write_text(*folder_ / "bends.yaml", rig_to_yaml(rig));
  const std::string at = quoted(folder_->path());
  const CommandResult done =
      run_lightstripe("measure " + at + "/profiles.csv --kind rail --rails two --wheelset S1002 --rig " + at +
                      "/bends.yaml --conicity " + at + "/bc.csv -o " + at + "/b.csv");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  CsvReader rows(*folder_ / "b.csv",
                 {"gauge_sigma", "conicity_sigma", "side_wear_sigma", "calibration_error"}),
      before(*folder_ / "m.csv", {"conicity_sigma", "side_wear_sigma", "calibration_error"});
  while (rows.next() && before.next()) {
    EXPECT_NEAR(rows.number(0), 0.2, 0.03);
    EXPECT_GT(rows.number(1), 1.1 * before.number(0));
    EXPECT_NEAR(rows.number(2), before.number(1), 0.003) << "a rigid move is no wear";
    EXPECT_EQ(rows.text(3), "counted");
    EXPECT_EQ(before.text(2), "not counted");
  }
  CsvReader amplitudes(*folder_ / "bc.csv", {"tan_gamma_e_sigma"}),
      without(*folder_ / "conicity.csv", {"tan_gamma_e_sigma"});
  double with_bends = 0, alone = 0;
  while (amplitudes.next() && without.next())
    if (!amplitudes.text(0).empty() && !without.text(0).empty())
      with_bends += amplitudes.number(0), alone += without.number(0);
  EXPECT_GT(with_bends, 1.1 * alone);
}

TEST_F(Track, TablesForExcelHaveSemicolonsAndDecimalCommas) {
  const std::string at = quoted(folder_->path());
  ASSERT_EQ(run_lightstripe("conicity --wheel S1002 --rail 60E1 --csv-style excel -o " + at +
                            "/e.csv --contacts " + at + "/ec.csv --quiet")
                .exit_code,
            0);
  EXPECT_THAT(text_of(*folder_ / "e.csv"), HasSubstr("y_mm;delta_r_mm;tan_gamma_e"));
  EXPECT_THAT(text_of(*folder_ / "e.csv"), HasSubstr("\n3;0,"));
  EXPECT_THAT(text_of(*folder_ / "ec.csv"), HasSubstr("shift_mm;roll_mrad"));
}

TEST_F(Track, WheelsetNeedsATrack) {
  const std::string at = quoted(folder_->path());
  const CommandResult one =
      run_lightstripe("measure " + at + "/profiles.csv --kind rail --wheelset S1002 -o " + at + "/x.csv");
  EXPECT_EQ(one.exit_code, 1);
  EXPECT_THAT(one.err, HasSubstr("--rails two"));
  const CommandResult none =
      run_lightstripe("measure " + at + "/profiles.csv --kind rail --rails two --conicity " + at +
                      "/c.csv -o " + at + "/x.csv");
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_THAT(none.err, HasSubstr("--wheelset"));
}

}  // namespace
}  // namespace lightstripe
