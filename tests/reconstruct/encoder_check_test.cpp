// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/encoder_check.h"

#include <gmock/gmock.h>

#include <cmath>

namespace lightstripe {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

TravelReadings readings(const std::vector<double>& travel) {
  TravelReadings out;
  for (std::size_t i = 0; i < travel.size(); ++i) out.emplace_back(static_cast<std::int64_t>(i), travel[i]);
  return out;
}

std::vector<double> travel_of(const CheckedReadings& checked) {
  std::vector<double> out;
  for (const auto& [frame, travel] : checked.readings) out.push_back(travel);
  return out;
}

CheckedReadings check(const std::vector<double>& travel, MotionType motion = MotionType::kLinear) {
  return check_encoder(readings(travel), motion);
}

/// A cart's travel in mm by a counter of this many counts at 0.01 mm, which began at `start`.
std::vector<double> counted(double counts, double start, int frames, double step, bool is_signed = false) {
  std::vector<double> out;
  for (int i = 0; i < frames; ++i) {
    double count = std::round((start + i * step + (i % 3) * 0.13) / 0.01);
    count -= counts * std::floor((count + (is_signed ? counts / 2 : 0)) / counts);
    out.push_back(count * 0.01);
  }
  return out;
}

TEST(EncoderCheck, WrapsOf16And32BitsAreUndoneInBothDirections) {
  for (const double counts : {65536.0, 4294967296.0})
    for (const double step : {2.0, -2.0})
      for (const bool is_signed : {false, true}) {
        const double end = (is_signed ? counts / 2 : step > 0 ? counts : 0) * 0.01, start = end - 5.2 * step;
        const std::vector<double> raw =
            counted(counts, is_signed && step < 0 ? -end - 5.2 * step : start, 12, step, is_signed);
        const CheckedReadings checked = check(raw);
        ASSERT_THAT(checked.warnings, ElementsAre(HasSubstr("begun anew")))
            << counts << " " << step << is_signed;
        const auto found = travel_of(checked);
        for (std::size_t i = 1; i < found.size(); ++i) EXPECT_NEAR(found[i] - found[i - 1], step, 0.3);
      }
}

// The files of ../shared/cases/files/11-encoder-wrap.
TEST(EncoderCheck, TheReportedTablesAreSeenThrough) {
  const CheckedReadings wrap = check({650, 652.5, 654, 1.14, 2.64, 5.14, 6.64, 9.14, 10.64, 13.14});
  EXPECT_THAT(wrap.warnings, ElementsAre(HasSubstr("frame 3: the counter has begun anew after 655.36 mm")));
  EXPECT_NEAR(wrap.readings.back().second, 668.5, 1e-9);
  for (const double error : {42949672.95, -9999.0}) {
    const CheckedReadings spike = check({0, 2.5, 4, 6.5, 8, 10.5, error, 14.5, 16, 18.5, 20, 22.5});
    EXPECT_THAT(spike.warnings, ElementsAre(AllOf(HasSubstr("left out"), HasSubstr("frame 6"))));
    EXPECT_THAT(spike.readings, SizeIs(11));
  }
  const CheckedReadings stuck = check({0, 2.5, 4, 4, 4, 4, 4, 14.5, 16, 18.5, 20, 22.5});
  EXPECT_THAT(stuck.warnings, ElementsAre(HasSubstr("frames 3 to 6")));
  EXPECT_THAT(stuck.readings, SizeIs(12));
}

TEST(EncoderCheck, AJumpThatIsNoWrapIsNamedAndStays) {
  const std::vector<double> travel = {0, 2, 4, 6, 308.4, 310.4, 312.4, 314.4};
  const CheckedReadings checked = check(travel);
  EXPECT_THAT(checked.warnings, ElementsAre(HasSubstr("frame 4: the travel jumps by 302.4 mm")));
  EXPECT_EQ(travel_of(checked), travel);
}

TEST(EncoderCheck, WhatARigDoesIsLeftAlone) {
  EXPECT_THAT(check({0, 2, 4, 6, 8, 10, 12}).warnings, IsEmpty());
  EXPECT_THAT(check({0, 2, 4, 4, 6, 10, 19, 30, 31}).warnings, IsEmpty()) << "a walk";
  EXPECT_THAT(check({0, 2, 4, 6, 8, 10, 8, 6, 4, 2}).warnings, IsEmpty()) << "there and back";
  EXPECT_THAT(check({0, 2, 4, 6, 2, 6, 8, 10}).warnings, IsEmpty()) << "a step back";
  EXPECT_THAT(check({356, 358, 0, 2, 4, 6, 8}, MotionType::kRotary).warnings, IsEmpty()) << "a full turn";
  const std::vector<double> sparse = {0, 2, 4, 6, 8, 10};
  TravelReadings with_gap = readings(sparse);
  with_gap.emplace_back(200, 400);
  EXPECT_THAT(check_encoder(with_gap, MotionType::kLinear).warnings, IsEmpty()) << "195 frames later";
}

TEST(EncoderCheck, ACounterThatNeverMovedIsNamed) {
  EXPECT_THAT(check({0, 0, 0, 0, 0, 0}).warnings, ElementsAre(HasSubstr("frames 1 to 5")))
      << "not plugged in";
}

TEST(EncoderCheck, ACounterThatWasResetIsNamed) {
  const std::vector<double> travel = {0, 2, 4, 6, 8, 10, 0, 2, 4, 6, 8, 10};
  const CheckedReadings checked = check(travel);
  EXPECT_THAT(checked.warnings, ElementsAre(HasSubstr("frame 6: the travel jumps by -10 mm")));
  EXPECT_EQ(travel_of(checked), travel);
}

TEST(EncoderCheck, SeveralErrorsInARowAreLeftOut) {
  const CheckedReadings checked = check({0, 2, 4, -9999, -9999, -9999, 12, 14, 16, 18});
  EXPECT_THAT(travel_of(checked), ElementsAre(0, 2, 4, 12, 14, 16, 18));
  EXPECT_THAT(checked.warnings, ElementsAre(HasSubstr("frames 3 to 5")));
}

}  // namespace
}  // namespace lightstripe
