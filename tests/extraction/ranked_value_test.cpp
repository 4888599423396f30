// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/ranked_value.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/error.h"
#include "core/random.h"

namespace lightstripe {
namespace {

TEST(RankedValue, IsThatOfTheSortedValuesForEveryRankAndSize) {
  Random random(3);
  for (std::size_t size = 1; size <= 700; size = size < 40 ? size + 1 : size + 73)
    for (const double levels : {0.0, 1.0, 5.0}) {  // all different, all alike, a few
      std::vector<float> values(size);
      for (float& value : values) {
        const double v = random.uniform(-1, 1);
        value = static_cast<float>(levels > 0 ? static_cast<int>(v * levels) : v);
      }
      std::vector<float> sorted = values;
      std::sort(sorted.begin(), sorted.end());
      for (std::size_t rank = 0; rank < size; rank += 1 + size / 17)
        ASSERT_EQ(ranked_value(values, rank), sorted[rank]) << size << " " << levels << " " << rank;
      EXPECT_EQ(ranked_median(values), sorted[size / 2]);
    }
}

TEST(RankedValue, SortedValuesAreNoTrap) {
  std::vector<float> values(300);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i);
  EXPECT_EQ(ranked_median(values), 150.0F);
  std::reverse(values.begin(), values.end());
  EXPECT_EQ(ranked_median(values), 150.0F);
}

TEST(RankedValue, MedianOfNothingIsNought) {
  std::vector<float> none, some = {5, 1, 3};
  EXPECT_EQ(ranked_median(none), 0);
  EXPECT_EQ(ranked_median(some), 3);
}

TEST(RankedValue, ARankBeyondTheValuesIsRefused) {
  std::vector<float> values(3, 1.0F);
  EXPECT_ANY_THROW(ranked_value(values, 3));
}

}  // namespace
}  // namespace lightstripe
