// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/number_text.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/random.h"

namespace lightstripe {
namespace {

std::string decimals(double value, int count) {
  std::string out;
  append_decimals(out, value, count);
  return out;
}

TEST(NumberText, ParsesWholeTextsOnly) {
  EXPECT_EQ(parse_number("-1.5e3"), -1500.0);
  EXPECT_EQ(parse_number("+2"), 2.0);
  EXPECT_EQ(parse_number(".5"), 0.5);
  for (const char* text :
       {"", " 1", "1 ", "1,5", "0x10", "nan", "inf", "-inf", "1e999", "++1", "+-1", "1.2.3", "e5"})
    EXPECT_EQ(parse_number(text), std::nullopt) << text;
}

TEST(NumberText, IntegersStayWithinTheirRange) {
  EXPECT_EQ(parse_integer("-9223372036854775808"), std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(parse_integer("9223372036854775808"), std::nullopt);
  EXPECT_EQ(parse_integer("3.0"), std::nullopt);
  EXPECT_EQ(parse_unsigned("18446744073709551615"), std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(parse_unsigned("-1"), std::nullopt);
}

TEST(NumberText, ShortestReadsBackToTheSameBits) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const double value = random.gaussian() * std::pow(10.0, random.uniform(-300, 300));
    EXPECT_EQ(parse_number(shortest_text(value)), value);
  }
  EXPECT_EQ(shortest_text(0.1), "0.1");
}

TEST(NumberText, DecimalsAreRoundedAndZerosLeftOut) {
  EXPECT_EQ(decimals(12.5, 5), "12.5");
  EXPECT_EQ(decimals(-0.000004, 5), "0");
  EXPECT_EQ(decimals(-0.000006, 5), "-0.00001");
  EXPECT_EQ(decimals(1.999999, 5), "2");
  EXPECT_EQ(decimals(-3.00507, 5), "-3.00507");
  EXPECT_EQ(decimals(1640.123456789, 9), "1640.123456789");
  EXPECT_EQ(decimals(7, 0), "7");
  EXPECT_EQ(decimals(-0.5, 0), "-1");
  EXPECT_EQ(decimals(2.5, 0), "3");
  EXPECT_EQ(decimals(0.00001, 5), "0.00001");
  EXPECT_EQ(decimals(100, 5), "100");
  EXPECT_EQ(decimals(-1200.5, 3), "-1200.5");
  EXPECT_EQ(decimals(8.999999999e15, 0), "8999999999000000");
  EXPECT_EQ(decimals(1e300, 5), "1e+300");
  EXPECT_EQ(decimals(std::numeric_limits<double>::quiet_NaN(), 5), "");
}

TEST(NumberText, DecimalsAreWithinHalfAUnitOfTheLastPlace) {
  Random random(2);
  for (int i = 0; i < 10'000; ++i) {
    const double value = random.uniform(-5000, 5000);
    // Half a unit, and the rounding of the product and of the parsed text: 5000 * 2^-52 each.
    EXPECT_NEAR(*parse_number(decimals(value, 5)), value, 0.5e-5 + 3e-12);
  }
}

}  // namespace
}  // namespace lightstripe
