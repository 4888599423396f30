// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/utf8.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "io/yaml_node.h"

namespace lightstripe {
namespace {

TEST(Utf8, TakesWhatRfc3629Has) {
  for (const char* text : {"", "a", "\xc3\xa4", "\xe2\x82\xac", "\xed\x9f\xbf", "\xee\x80\x80",
                           "\xf0\x90\x80\x80", "\xf4\x8f\xbf\xbf", "mixed \xc3\x9f and \xf0\x9f\x98\x80"})
    EXPECT_TRUE(is_utf8(text)) << text;
}

TEST(Utf8, RefusesOverlongFormsSurrogatesAndHalves) {
  for (const char* text :
       {"\xc0\xbb", "\xc1\xbf", "\xe0\x9f\xbf", "\xf0\x8f\xbf\xbf", "\xed\xa0\x80", "\xf4\x90\x80\x80",
        "\xf5\x80\x80\x80", "\x80", "\xc3", "\xe2\x82", "\xf0\x9f\x98", "a\xff", "\xc3\x28"})
    EXPECT_FALSE(is_utf8(text)) << text;
}

// Found by libFuzzer: yaml-cpp takes the overlong form for another character, and a name was written back
// otherwise.
TEST(Utf8, YamlInOverlongFormsIsRefused) {
  EXPECT_THROW(detail::parse_yaml("frames: {gauge: D\xc0\xbb}\n", {"scan.yaml", ""}), Error);
}

}  // namespace
}  // namespace lightstripe
