// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "core/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

namespace lightstripe {
namespace {

constexpr int kDraws = 200000;

TEST(ScatterBits, AgreesWithSplitMix64) {
  // The published generator: state += golden gamma, then finalize; its first two outputs from seed 1234567.
  EXPECT_EQ(scatter_bits(1234567), 6457827717110365317ULL);
  EXPECT_EQ(scatter_bits(1234567 + 0x9e3779b97f4a7c15ULL), 3203168211198807973ULL);
}

TEST(Random, SameSeedAndStreamGiveTheSameNumbers) {
  Random a(42, 7), b(42, 7);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(a.bits(), b.bits());
}

TEST(Random, SeedsAndStreamsDiffer) {
  std::set<std::uint64_t> first;
  for (std::uint64_t seed = 0; seed < 100; ++seed)
    for (std::uint64_t stream = 0; stream < 100; ++stream) first.insert(Random(seed, stream).bits());
  EXPECT_EQ(first.size(), 10000u);
}

TEST(Random, NeighbouringStreamsAreUncorrelated) {
  // The correlation of kDraws independent pairs has sigma 1 / sqrt(kDraws) = 0.0022; 5 sigma.
  Random a(1, 0), b(1, 1);
  double sum = 0;
  for (int i = 0; i < kDraws; ++i) sum += a.gaussian() * b.gaussian();
  EXPECT_NEAR(sum / kDraws, 0, 0.0112);
}

TEST(Random, UniformFillsItsIntervalEvenly) {
  Random random(3);
  std::vector<int> bins(20);
  for (int i = 0; i < kDraws; ++i) {
    const double value = random.uniform();
    ASSERT_GE(value, 0);
    ASSERT_LT(value, 1);
    ++bins[static_cast<std::size_t>(20 * value)];
  }
  // Each bin: 10000 +- sqrt(9500) = 97; 5 sigma.
  for (int count : bins) EXPECT_NEAR(count, kDraws / 20, 490);
}

TEST(Random, GaussianHasTheMomentsOfAStandardNormal) {
  Random random(4);
  double m1 = 0, m2 = 0, m3 = 0, m4 = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double g = random.gaussian();
    m1 += g, m2 += g * g, m3 += g * g * g, m4 += g * g * g * g;
  }
  // Standard errors / sqrt(kDraws): 1, sqrt 2, sqrt 15, sqrt 96; 5 sigma.
  EXPECT_NEAR(m1 / kDraws, 0, 5 * 0.00224);
  EXPECT_NEAR(m2 / kDraws, 1, 5 * 0.00317);
  EXPECT_NEAR(m3 / kDraws, 0, 5 * 0.00867);
  EXPECT_NEAR(m4 / kDraws, 3, 5 * 0.0220);
}

}  // namespace
}  // namespace lightstripe
