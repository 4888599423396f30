// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/charts_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace lightstripe {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// What the page's script finds as `data`.
nlohmann::json data_of(const std::string& html) {
  const std::string begin = "<script id=\"data\" type=\"application/json\">";
  const std::size_t from = html.find(begin) + begin.size();
  return nlohmann::json::parse(html.substr(from, html.find("</script>", from) - from));
}

TEST(ChartsPage, HasEveryNumberAndNullWhereThereIsNone) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  const LineChart chart{"step", "travel, mm", "mm", {{"a", {0, 1}, {2.5, nothing}, {0.1, 0}, false}},
                        {3},    false};
  const auto data =
      data_of(charts_page_html({"T", "fine", true, {"what", "n"}, {{"step", "1"}}, {}, {chart}}));
  const auto& line = data["charts"][0]["lines"][0];
  EXPECT_EQ(line["y"][0], 2.5);
  EXPECT_TRUE(line["y"][1].is_null());
  EXPECT_EQ(line["half"][0], 0.1);
  EXPECT_EQ(data["charts"][0]["limits"][0], 3);
  EXPECT_EQ(data["rows"][0][1], "1");
  EXPECT_EQ(data["good"], true);
}

TEST(ChartsPage, TextCannotEndTheScriptOrTheTitle) {
  const std::string html = charts_page_html({"</title><b>", "</script><img src=x>", {}, {}, {}, {}, {}});
  EXPECT_THAT(html, Not(HasSubstr("</title><b>")));
  EXPECT_THAT(html, Not(HasSubstr("<img src=x>")));
  EXPECT_EQ(data_of(html)["verdict"], "</script><img src=x>");
}

}  // namespace
}  // namespace lightstripe
