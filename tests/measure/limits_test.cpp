// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/limits.h"

#include <gtest/gtest.h>

namespace lightstripe {
namespace {

MeasuredFrame row(std::optional<double> vertical, std::optional<double> side) {
  MeasuredFrame out;
  const auto estimate = [](std::optional<double> value) {
    return value ? Estimate::known(*value, 0.01) : Estimate::unknown("not seen");
  };
  out.estimates = {{"vertical_wear", estimate(vertical)}, {"side_wear", estimate(side)}};
  return out;
}

TEST(Limits, NoneGivesNoVerdict) { EXPECT_EQ(judge(row(5, 5), {}), Verdict::kNone); }

TEST(Limits, DecideOnWhatIsKnown) {
  Limits limits;
  limits.vertical_wear_max = 3;
  EXPECT_EQ(judge(row(2, 9), limits), Verdict::kPass);
  EXPECT_EQ(judge(row(3.1, 0), limits), Verdict::kFail);
  EXPECT_EQ(judge(row(std::nullopt, 0), limits), Verdict::kUnknown);
}

TEST(Limits, AFailureOutweighsWhatIsUnknown) {
  Limits limits;
  limits.vertical_wear_max = 3;
  limits.side_wear_max = 2;
  EXPECT_EQ(judge(row(std::nullopt, 2.5), limits), Verdict::kFail);
  EXPECT_EQ(judge(row(3.5, std::nullopt), limits), Verdict::kFail);
  EXPECT_EQ(judge(row(1, std::nullopt), limits), Verdict::kUnknown);
}

TEST(Limits, BoundsBelongToTheirQuantity) {
  Limits limits;
  limits.flange_height_min = 27.5;
  limits.flange_height_max = 36;
  EXPECT_EQ(bounds_of("flange_height", limits).low, 27.5);
  EXPECT_EQ(bounds_of("flange_height", limits).high, 36);
  EXPECT_FALSE(bounds_of("height", limits).low);
}

}  // namespace
}  // namespace lightstripe
