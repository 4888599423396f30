// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/outside_range.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lightstripe {
namespace {

using ::testing::HasSubstr;

Rig rig_with_range() {
  Rig rig;
  rig.sensors.push_back({"gauge", {}, {}, {}, {330, 506}});
  return rig;
}

TEST(OutsideRange, NamesTheRangeThatHelps) {
  const auto texts = outside_range_texts({{0, 240, 512.3, 559.1}}, rig_with_range());
  ASSERT_EQ(texts.size(), 1u);
  EXPECT_THAT(texts[0], HasSubstr("240 stripe points of gauge may lie outside its depth_range [330, 506]"));
  EXPECT_THAT(texts[0], HasSubstr("depth_range: [330, 560] in rig.yaml"));
}

TEST(OutsideRange, WhereNothingIsCertainItNamesNone) {
  const auto texts = outside_range_texts({{0, 240, 0, 0}}, rig_with_range());
  ASSERT_EQ(texts.size(), 1u);
  EXPECT_THAT(texts[0], Not(HasSubstr("depth_range: [")));
  EXPECT_THAT(texts[0], HasSubstr("in which the object lies"));
}

TEST(OutsideRange, LinesThatGaveNoPointAreNotCalledNoStripe) {
  ScanSummary summary;
  summary.frames = 3, summary.rays_missed = 240;
  const std::string text = why_all_missed(summary, {"240 points may lie outside"});
  EXPECT_THAT(text, HasSubstr("lines were seen in 3 frames"));
  EXPECT_THAT(text, HasSubstr("240 points may lie outside"));
}

}  // namespace
}  // namespace lightstripe
