// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fields.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

namespace lightstripe {
namespace {

enum class Colour { kRed, kGreen, kUnnamed };
constexpr std::array<EnumName<Colour>, 2> enum_names(Colour) {
  return {{{Colour::kRed, "red"}, {Colour::kGreen, "green"}}};
}

struct Inner {
  int count = 3;
};
template <class V>
void visit_fields(V&& v, Inner& o) {
  v("count", o.count);
}

struct Outer {
  double width_px = 1.5;
  Inner inner;
};
template <class V>
void visit_fields(V&& v, Outer& o) {
  v("width_px", o.width_px, "a comment");
  v("inner", o.inner);
}

struct NoFields {
  int x = 0;
};

// As a reader or a dumper would: goes down into structs by the concept.
struct NameCollector {
  std::vector<std::string>& names;
  std::string prefix;

  template <class T>
  void operator()(std::string_view name, T& value, std::string_view = {}) const {
    if constexpr (HasFields<T>)
      visit_fields(NameCollector{names, prefix + std::string(name) + "."}, value);
    else
      names.push_back(prefix + std::string(name));
  }
};

static_assert(HasFields<Outer> && HasFields<Inner>);
static_assert(!HasFields<NoFields> && !HasFields<int> && !HasFields<std::string>);
static_assert(HasEnumNames<Colour> && !HasEnumNames<int>);

TEST(Fields, VisitorSeesEveryFieldInOrderAndGoesDown) {
  Outer outer;
  std::vector<std::string> names;
  visit_fields(NameCollector{names, ""}, outer);
  EXPECT_EQ(names, (std::vector<std::string>{"width_px", "inner.count"}));
}

TEST(Fields, VisitorMayWrite) {
  Inner inner;
  visit_fields([](std::string_view, int& value) { value = 8; }, inner);
  EXPECT_EQ(inner.count, 8);
}

TEST(EnumName, IsFoundByTheEnumsNamespace) {
  EXPECT_EQ(enum_name(Colour::kGreen), "green");
  EXPECT_EQ(enum_name(Colour::kUnnamed), "?");
}

}  // namespace
}  // namespace lightstripe
