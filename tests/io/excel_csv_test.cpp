// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/excel_csv.h"

#include <gtest/gtest.h>

namespace lightstripe {
namespace {

TEST(ExcelCsv, NumbersGetAComma) {
  EXPECT_EQ(excel_csv("frame,travel,name\n1,-2.50,60E1\n2,1e-05,\n"),
            "\xEF\xBB\xBF"
            "frame;travel;name\r\n1;-2,50;60E1\r\n2;1e-05;\r\n");
}

TEST(ExcelCsv, TextsStayAsTheyAre) {
  EXPECT_EQ(excel_csv("a,\"one, two \"\"three\"\"\",v1.2.3,img_2.png,a;b\n"),
            "\xEF\xBB\xBF"
            "a;\"one, two \"\"three\"\"\";v1.2.3;img_2.png;\"a;b\"\r\n");
}

TEST(ExcelCsv, ALastLineWithoutAnEndAndNothingAtAll) {
  EXPECT_EQ(excel_csv("a,1.5"),
            "\xEF\xBB\xBF"
            "a;1,5");
  EXPECT_EQ(excel_csv(""), "\xEF\xBB\xBF");
}

}  // namespace
}  // namespace lightstripe
