// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// How an options struct names its fields, once: the list drives YAML reading and dumping, the command line
// and tests.
//
//   struct SmoothingOptions { double sigma_px = 1.5; };                     // the only place of the default
//   template <class V> void visit_fields(V&& v, SmoothingOptions& o) { v("sigma_px", o.sigma_px); }
//
// A field may be bool, int, double, std::string, an enum with enum_names(), std::optional, std::vector or
// std::array of these, an Eigen vector, or a struct with visit_fields of its own. A third argument is a
// comment for dumps and --help.
#pragma once

#include <string_view>
#include <utility>

namespace lightstripe {

namespace detail {
struct AnyVisitor {
  template <class T>
  void operator()(std::string_view, T&, std::string_view = {}) const {}
};
}  // namespace detail

/// A struct that lists its fields.
template <class T>
concept HasFields = requires(T& object) {
  visit_fields(detail::AnyVisitor{}, object);
};

/// One spelling of an enum's value; `constexpr std::array<EnumName<E>, N> enum_names(E)` is found by the
/// enum's namespace.
template <class E>
struct EnumName {
  E value;
  std::string_view name;
};

template <class E>
concept HasEnumNames = requires(E value) {
  enum_names(value);
};

/// The name of an enum's value ("?" if it has none).
template <HasEnumNames E>
constexpr std::string_view enum_name(E value) {
  for (const auto& entry : enum_names(value))
    if (entry.value == value) return entry.name;
  return "?";
}

}  // namespace lightstripe
