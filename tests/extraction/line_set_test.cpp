// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/line_set.h"

#include <gtest/gtest.h>

namespace lightstripe {
namespace {

/// Three points of sigma 0.03 px, of which the last belongs to no line.
LineSet short_line() {
  LineSet lines;
  lines.points.resize(3);
  for (StripePoint& p : lines.points) p.sigma_px = 0.03;
  lines.lines.push_back({0, 2});
  return lines;
}

TEST(LineSet, SystematicErrorsAddToSigmaAsSquares) {
  LineSet lines = short_line();
  lines.systematic = {0.04F, 0.002F, 0.04F};
  add_systematic_errors(lines);
  EXPECT_NEAR(lines.points[0].sigma_px, 0.05, 1e-7);
  EXPECT_EQ(lines.points[1].sigma_px, 0.03);  // a tenth would change it by 0.5 %
  EXPECT_EQ(lines.points[2].sigma_px, 0.03);
}

TEST(LineSet, WithoutSystematicErrorsSigmaStays) {
  LineSet lines = short_line();
  add_systematic_errors(lines);
  EXPECT_EQ(lines.points[0].sigma_px, 0.03);
}

}  // namespace
}  // namespace lightstripe
