// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The table of measurements, what it is made from, and the record beside it.
#include "pipeline/measurement_table.h"

#include <gmock/gmock.h>

#include "core/error.h"
#include "io/atomic_file.h"
#include "pipeline/measure_input.h"
#include "pipeline/measure_references.h"
#include "pipeline/run_record.h"
#include "tests/io/temp_folder.h"

namespace lightstripe {
namespace {

using ::testing::HasSubstr;

MeasuredFrame row_with_wear(std::optional<double> wear, const std::string& reason = "") {
  MeasuredFrame row;
  for (const std::string& name : estimate_names(ObjectKind::kRail)) row.estimates.push_back({name, {}});
  row.estimates[0].estimate.value = wear;
  row.estimates[0].estimate.reason = reason;
  row.status = "ok";
  return row;
}

TEST(MeasurementTable, SpreadCountsKnownRowsOnly) {
  const std::vector<MeasuredFrame> rows{row_with_wear(1.0), row_with_wear({}, "not seen"),
                                        row_with_wear(4.0)};
  const Spread spread = spread_of(rows, estimate_names(ObjectKind::kRail)[0]);
  EXPECT_EQ(spread.known, 2);
  EXPECT_EQ(spread.low, 1.0);
  EXPECT_EQ(spread.high, 4.0);
  EXPECT_EQ(spread.mean, 2.5);
  EXPECT_EQ(find_estimate(rows[0], "colour"), nullptr);
}

TEST(MeasurementTable, AnUnknownCellIsEmptyAndNamedWithItsReason) {
  const std::string first = estimate_names(ObjectKind::kRail)[0];
  const MeasuredFrame row = row_with_wear({}, "gauge face not seen");
  EXPECT_THAT(missing_of(row), HasSubstr(first + ": gauge face not seen"));
  const std::string table = measurement_table({row}, ObjectKind::kRail, {}, {"unknown"}, "not counted");
  EXPECT_THAT(table, HasSubstr("frame,travel,nominal," + first + "," + first + "_sigma,"));
  EXPECT_THAT(table, HasSubstr(",ok,unknown,"));
  EXPECT_THAT(table, HasSubstr(",verdict,missing,calibration_error\n"));
  EXPECT_THAT(table, ::testing::EndsWith(",not counted\n"));
}

TEST(MeasureInput, ReferencesAreNamesOrFilesOfTheRightKind) {
  EXPECT_EQ(read_reference("", ObjectKind::kRail).name(), "60E1");
  EXPECT_EQ(read_reference("", ObjectKind::kWheel).kind(), ObjectKind::kWheel);
  EXPECT_THROW(read_reference("S1002", ObjectKind::kRail), Error);
  EXPECT_THROW(read_measure_input("no_such.csv", ObjectKind::kRail), Error);
}

TEST(MeasureReferences, RefusesAChoiceThatTheSectionsCannotAnswer) {
  MeasureInput input;
  input.file = "sections.csv";
  input.profiles.resize(3);
  EXPECT_THROW(MeasureReferences({.nominal_right = "60E1"}, input, {}, {}), Error);
  EXPECT_THROW(MeasureReferences({.two_rails = true}, input, {}, {}), Error) << "no point lies anywhere";
  EXPECT_EQ(MeasureReferences({}, input, {}, {}).at(0).name(), "60E1");
  input.kind = ObjectKind::kWheel;
  EXPECT_THROW(MeasureReferences({.nominal = "auto"}, input, {}, {}), Error);
}

TEST(RunRecord, NamesVersionOptionsAndInputsWithTheirHash) {
  const TempFolder folder;
  write_file(folder.path() / "in", "foobar");
  write_run_record(folder.path() / "out.csv", "measure", {folder.path() / "in"}, "a:\n" + indented("b: 1\n"));
  const std::string record = read_file(folder.path() / "out.csv.run.yaml");
  EXPECT_THAT(record, HasSubstr("command: measure\n"));
  // As sha256sum prints it.
  EXPECT_THAT(
      record,
      HasSubstr("bytes: 6, sha256: \"c3ab8ff13720e8ad9047dd39466b3c8974e592c2fa383d4a3960714caef0c4f2\""));
  EXPECT_THAT(record, HasSubstr("a:\n  b: 1\n"));
}

}  // namespace
}  // namespace lightstripe
