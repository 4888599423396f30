// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// One-sided glow moves the centre; kernels of different scale disagree there, and sigma_px says so.
#include "extraction/lines/line_asymmetry.h"

#include <gtest/gtest.h>

#include "extraction/extract_stripes.h"
#include "simulate/real_stripe.h"

namespace lightstripe {
namespace {

RealScore score_of(const RealStripe& stripe) {
  RealScore score;
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
    add_to(score, stripe, extract_stripes(picture_of(stripe, seed).view()).stripes);
  return score;
}

TEST(LineAsymmetry, GlowIsNotHiddenInSigma) {
  for (const double glow : {0.15, 0.5}) {
    RealStripe stripe;
    stripe.glow = glow;
    const RealScore score = score_of(stripe);
    EXPECT_GT(score.completeness(), 0.99) << glow;
    EXPECT_GT(score.rms(), 0.05) << glow;  // nobody can take the bias back
    EXPECT_LT(score.rms_surprise(), 2) << glow;
  }
}

TEST(LineAsymmetry, OfEvenStripesNothingIsAdded) {
  const RealScore score = score_of({});
  EXPECT_LT(score.sigma(), 0.02);
  EXPECT_NEAR(score.rms_surprise(), 1, 0.35);
}

}  // namespace
}  // namespace lightstripe
