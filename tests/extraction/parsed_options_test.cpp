// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/parsed_options.h"

#include <gmock/gmock.h>

#include "core/error.h"

namespace lightstripe {
namespace {

using ::testing::HasSubstr;

std::string complaint(const ExtractionOptions& options) {
  try {
    parse_options(options);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ParsedOptions, TextsBecomeNumbers) {
  ExtractionOptions options;
  options.thresholds = "20,60.5", options.roi = "10,20,300,40", options.start = "7.5,-2";
  const ParsedOptions parsed = parse_options(options);
  EXPECT_EQ(parsed.rule, ThresholdRule::kGiven);
  EXPECT_EQ(parsed.given.low, 20);
  EXPECT_EQ(parsed.given.high, 60.5);
  ASSERT_TRUE(parsed.roi && parsed.start);
  EXPECT_EQ(parsed.roi->x, 10);
  EXPECT_EQ(parsed.roi->y, 20);
  EXPECT_EQ(parsed.roi->width, 300);
  EXPECT_EQ(parsed.roi->height, 40);
  EXPECT_EQ(parsed.start->x, 7.5);
  EXPECT_EQ(parsed.start->y, -2);
}

TEST(ParsedOptions, NamedThresholds) {
  ExtractionOptions options;
  EXPECT_EQ(parse_options(options).rule, ThresholdRule::kBilevel);
  options.thresholds = "otsu";
  EXPECT_EQ(parse_options(options).rule, ThresholdRule::kOtsu);
  options.thresholds = "rosin";
  EXPECT_EQ(parse_options(options).rule, ThresholdRule::kRosin);
}

TEST(ParsedOptions, ATextIsReadToItsEndAndInOrder) {
  for (const char* text : {"60,20", "20", "20,", "20,60,80", "20;60", "a,b", "-1,5", "1,inf"}) {
    ExtractionOptions options;
    options.thresholds = text;
    EXPECT_THAT(complaint(options), HasSubstr(std::string("thresholds: '") + text + "'")) << text;
  }
  for (const char* text : {"0,0,0,5", "-1,0,5,5", "1,2,3", "1,2,3,4,5"}) {
    ExtractionOptions options;
    options.roi = text;
    EXPECT_THAT(complaint(options), HasSubstr("roi")) << text;
  }
}

TEST(ParsedOptions, RangesIncludeTheirEnds) {
  ExtractionOptions options;
  options.sigma = kLeastSigma;
  EXPECT_EQ(complaint(options), "");
  options.sigma = 0.69;
  EXPECT_THAT(complaint(options), HasSubstr("sigma: the value 0.69 is out of range; give 0.7 to 20 px"));
  options.sigma = kLargestSigma;
  EXPECT_EQ(complaint(options), "");
  options.sigma = 20.5;
  EXPECT_THAT(complaint(options), HasSubstr("sigma"));
}

}  // namespace
}  // namespace lightstripe
