// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/calibration_error_text.h"

#include <gmock/gmock.h>

namespace lightstripe {
namespace {

using ::testing::HasSubstr;

/// The only sentence, and that it is (not) a warning.
std::string only(const Messages& messages, bool warning) {
  EXPECT_EQ(messages.list.size(), 1U);
  EXPECT_EQ(messages.list.at(0).warning, warning);
  return messages.list.at(0).text;
}

TEST(CalibrationErrorText, SaysWhoseErrorCountsAndWhoNamedTheRig) {
  CalibrationErrors counted;
  counted.why_not.clear();
  EXPECT_EQ(only(describe_calibration_error({"a/rig.yaml", false, ""}, counted, "p.csv"), false),
            "the sigmas count the calibration's error: a/rig.yaml");
  EXPECT_THAT(only(describe_calibration_error({"a/rig.yaml", true, ""}, counted, "b/p.csv"), false),
              HasSubstr("a/rig.yaml, the rig that made p.csv"));
}

TEST(CalibrationErrorText, WarnsWhereWhatWasNamedDoesNotServe) {
  CalibrationErrors none;
  EXPECT_THAT(only(describe_calibration_error({{}, false, "it is gone"}, none, "p.csv"), true), "it is gone");
  none.why_not = "nothing is known of it";
  EXPECT_THAT(only(describe_calibration_error({"rig.yaml", false, ""}, none, "p.csv"), true),
              HasSubstr("do not count the calibration's error: nothing is known of it"));
  // A record can name a rig that was written by hand: nothing that the user could give is missing.
  EXPECT_THAT(only(describe_calibration_error({"rig.yaml", true, ""}, none, "p.csv"), false),
              HasSubstr("nothing is known of it"));
}

TEST(CalibrationErrorText, WithoutAnyRigSaysWhichOptionHelpsWhereOneCould) {
  EXPECT_THAT(only(describe_calibration_error({}, {}, "p.csv"), false), HasSubstr("give --rig rig.yaml"));
  EXPECT_TRUE(describe_calibration_error({}, {}, "wheel.whl").list.empty());
}

}  // namespace
}  // namespace lightstripe
