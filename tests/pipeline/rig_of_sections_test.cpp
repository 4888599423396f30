// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Word of the rig beside a table of sections.
#include "pipeline/rig_of_sections.h"

#include <gmock/gmock.h>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/rig_file.h"
#include "io/tables.h"
#include "pipeline/calibration_errors.h"
#include "pipeline/merge_job.h"
#include "tests/io/temp_folder.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Rig rig_of(double focal_px) {
  Rig rig;
  Sensor sensor;
  sensor.name = "gauge";
  sensor.camera = {960, 700, focal_px, focal_px, 480, 350, {}};
  sensor.laser_planes = {{Eigen::Vector3d(0.8, 0, 0.6), 330}};
  rig.sensors = {sensor};
  rig.motion.type = MotionType::kLinear;
  rig.quality.section_bends = SectionBends{{0, 0}, 100, {std::vector<double>(12, 0.01)}};
  return rig;
}

class RigBesideSections : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.write("cal/rig.yaml", rig_to_yaml(rig_of(1640)));
    table_ = folder_.write("scan/profiles.csv", std::string(kProfilesHeader) + row(0));
    leave_word(table_);
  }
  static std::string row(int frame) { return std::to_string(frame) + ",0,0,0,1,2,3,2,3,0.01\n"; }
  void leave_word(const fs::path& table) const {
    write_sections_record(table, "reconstruct", {table}, place_of_rig(rig(), rig_of(1640)), "changed");
  }
  fs::path rig() const { return folder_ / "cal/rig.yaml"; }
  RigOfSections found() const { return rig_of_sections(table_, {}); }

  TempFolder folder_;
  fs::path table_;
};

TEST_F(RigBesideSections, IsFoundByItsRecord) {
  EXPECT_TRUE(found().by_record);
  EXPECT_TRUE(fs::equivalent(found().file, rig()));
  EXPECT_THAT(found().warning, IsEmpty());
  EXPECT_THAT(read_file(table_.string() + ".run.yaml"), HasSubstr("from_here: ../cal/rig.yaml"));
}

TEST_F(RigBesideSections, IsFoundWhereTheFoldersWereMovedTogetherOrTheTableAlone) {
  const fs::path moved = folder_ / "elsewhere";
  fs::create_directories(moved);
  fs::rename(folder_ / "cal", moved / "cal");
  fs::rename(folder_ / "scan", moved / "scan");
  EXPECT_TRUE(fs::equivalent(rig_of_sections(moved / "scan/profiles.csv", {}).file, moved / "cal/rig.yaml"));
  fs::rename(moved / "cal", folder_ / "cal");
  EXPECT_TRUE(fs::equivalent(rig_of_sections(moved / "scan/profiles.csv", {}).file, rig()));
  folder_.write("elsewhere/cal/rig.yaml", rig_to_yaml(rig_of(1650)));  // another one beside it
  EXPECT_TRUE(fs::equivalent(rig_of_sections(moved / "scan/profiles.csv", {}).file, rig()));
}

TEST_F(RigBesideSections, ThatIsGoneIsMissedByName) {
  fs::remove(rig());
  EXPECT_THAT(found().file.string(), IsEmpty());
  EXPECT_THAT(found().warning, HasSubstr("the rig that made profiles.csv is gone"));
  EXPECT_THAT(found().warning, HasSubstr("--rig"));
}

TEST_F(RigBesideSections, ThatWasCalibratedAnewIsNotTaken) {
  write_file(rig(), rig_to_yaml(rig_of(1650)));
  EXPECT_THAT(found().file.string(), IsEmpty());
  EXPECT_THAT(found().warning, HasSubstr("rig.yaml has changed since profiles.csv was made with it"));
}

TEST_F(RigBesideSections, TheUsersOwnChoiceWinsAndIsQuestionedIfItIsAnother) {
  const fs::path other = folder_.write("other.yaml", rig_to_yaml(rig_of(1650))),
                 copy = folder_.write("copy.yaml", read_file(rig()));
  EXPECT_EQ(rig_of_sections(table_, other).file, other);
  EXPECT_THAT(rig_of_sections(table_, other).warning, HasSubstr("is not the rig that made profiles.csv"));
  EXPECT_EQ(rig_of_sections(table_, copy).file, copy);
  EXPECT_THAT(rig_of_sections(table_, copy).warning, IsEmpty());
}

TEST_F(RigBesideSections, ARecordOfAnotherTableSaysNothingOfThisOne) {
  write_file(table_, std::string(kProfilesHeader) + row(7));
  EXPECT_THAT(found().file.string(), IsEmpty());
  EXPECT_THAT(found().warning, HasSubstr("was written for another profiles.csv"));
  fs::remove(table_.string() + ".run.yaml");
  EXPECT_THAT(found().warning, IsEmpty()) << "no record: nothing is missing";
}

TEST_F(RigBesideSections, ARecordThatCannotBeReadIsNamed) {
  write_file(table_.string() + ".run.yaml", "table: {bytes: many}\n");
  EXPECT_THAT(found().warning, HasSubstr("profiles.csv.run.yaml"));
  write_file(table_.string() + ".run.yaml", "command: reconstruct\n");
  EXPECT_THAT(found().warning, HasSubstr("says nothing of the rig"));
}

TEST_F(RigBesideSections, ARigFileThatIsNotTheOneInUseIsNotNamed) {
  EXPECT_TRUE(place_of_rig(rig(), rig_of(1640)));
  EXPECT_FALSE(place_of_rig(rig(), rig_of(1650)));
  EXPECT_FALSE(place_of_rig(folder_ / "none.yaml", rig_of(1640)));
  write_file(rig(), "sensors: [");
  EXPECT_FALSE(place_of_rig(rig(), rig_of(1640)));
}

TEST_F(RigBesideSections, MergeCarriesItOnWhereAllPartsHaveTheSame) {
  const fs::path second = folder_.write("scan/second.csv", std::string(kProfilesHeader) + row(1));
  leave_word(second);
  const fs::path joined = folder_ / "joined/all.csv";
  EXPECT_THAT(merge({{second, table_}, joined}).warnings, IsEmpty());
  EXPECT_TRUE(fs::equivalent(rig_of_sections(joined, {}).file, rig()));
  EXPECT_THAT(read_file(joined.string() + ".run.yaml"), HasSubstr("command: merge"));
}

TEST_F(RigBesideSections, MergeOfPartsOfTwoRigsNamesNone) {
  const fs::path second = folder_.write("scan/second.csv", std::string(kProfilesHeader) + row(1)),
                 other = folder_.write("other.yaml", rig_to_yaml(rig_of(1650))), joined = folder_ / "all.csv";
  const auto expect_none = [&](const std::string& why) {
    const MergeResult result = merge({{table_, second}, joined});
    ASSERT_EQ(result.warnings.size(), 1U);
    EXPECT_THAT(result.warnings[0], HasSubstr(why));
    EXPECT_THAT(rig_of_sections(joined, {}).warning, HasSubstr("names no rig"));
  };
  expect_none("not all parts have a record");
  write_sections_record(second, "reconstruct", {second}, place_of_rig(other, rig_of(1650)), "");
  expect_none("was made with another rig than");
  write_sections_record(second, "reconstruct", {second}, std::nullopt, "changed while it ran");
  expect_none("names no rig");
}

TEST(CalibrationErrors, AreThoseOfTheRigFileAsFarAsTheyHoldForTheSections) {
  const TempFolder folder;
  Rig rig = rig_of(1640);
  rig.quality.section_absolute_sigma_mm = 0.05;
  rig.quality.sigma["motion.axis_point_mm"] = 0.4;
  const auto errors = [&](const std::string& table) {
    return calibration_errors(folder.write("rig.yaml", rig_to_yaml(rig)), table, {});
  };
  EXPECT_FALSE(calibration_errors({}, "profiles.csv", {}).counted());
  EXPECT_TRUE(errors("profiles.csv").counted());
  EXPECT_EQ(errors("profiles.csv").bends.bends.size(), 1U);
  EXPECT_EQ(errors("profiles.csv").place_sigma_mm, 0) << "counts among the bends";
  EXPECT_THAT(errors("wheel.whl").why_not, HasSubstr("railway file"));
  EXPECT_TRUE(errors("wheel.whl").bends.bends.empty());
  EXPECT_EQ(errors("wheel.whl").axis_sigma_mm, 0.4);
  rig.motion.type = MotionType::kRotary;
  EXPECT_THAT(errors("profiles.csv").why_not, HasSubstr("no distance from its axis"));
  rig.motion.type = MotionType::kLinear;
  rig.quality.section_bends.reset();
  EXPECT_THAT(errors("profiles.csv").why_not, HasSubstr("quality.section_bends"));
  EXPECT_EQ(errors("profiles.csv").place_sigma_mm, 0.05);
  EXPECT_THAT(calibration_yaml(errors("profiles.csv")), HasSubstr("not counted: the rig file"));
  EXPECT_EQ(calibration_word(errors("profiles.csv")), "not counted");
}

}  // namespace
}  // namespace lightstripe
