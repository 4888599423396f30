// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/kernels/kernels_recursive.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/random.h"

namespace lightstripe {
namespace {

TEST(KernelsRecursive, HandComputedRow) {
  const std::vector<float> ones(3, 1.0F), twos(3, 2.0F), zeros(3, 0.0F);
  RecursiveWeights weights;
  weights.input = {1, 10, 100, 1000}, weights.past = {0.5F, 0, 0, 4};
  std::vector<float> out(3);
  filter_row_recursively({ones.data(), twos.data(), ones.data(), zeros.data()},
                         {twos.data(), ones.data(), ones.data(), ones.data()}, weights, out.data(), 3);
  for (const float v : out) EXPECT_EQ(v, 1 + 20 + 100 - 1 - 4);
}

TEST(KernelsRecursive, VectorsAgreeWithTheScalarReferenceForAllTails) {
  Random random(5);
  std::vector<std::vector<float>> rows(8, std::vector<float>(70));
  for (auto& row : rows)
    for (float& v : row) v = static_cast<float>(random.uniform(-100, 100));
  RecursiveWeights weights;
  for (float& w : weights.input) w = static_cast<float>(random.uniform(-1, 1));
  for (float& w : weights.past) w = static_cast<float>(random.uniform(-1, 1));
  // Unaligned from the second place on.
  const RowPointers inputs{rows[0].data() + 1, rows[1].data() + 1, rows[2].data() + 1, rows[3].data() + 1};
  const RowPointers past{rows[4].data() + 1, rows[5].data() + 1, rows[6].data() + 1, rows[7].data() + 1};
  for (std::size_t count = 1; count <= 67; ++count) {
    std::vector<float> fast(70, -1.0F), plain(70, -1.0F);
    filter_row_recursively(inputs, past, weights, fast.data(), count);
    filter_row_recursively_scalar(inputs, past, weights, plain.data(), count);
    for (std::size_t i = 0; i < fast.size(); ++i) ASSERT_NEAR(fast[i], plain[i], 1e-4) << count << ", " << i;
  }
}

}  // namespace
}  // namespace lightstripe
