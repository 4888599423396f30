// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/number_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace lightstripe {
namespace {

template <class T>
std::optional<T> parse_whole(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  T value{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return value;
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
  const auto value = parse_whole<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<std::int64_t> parse_integer(std::string_view text) { return parse_whole<std::int64_t>(text); }
std::optional<std::uint64_t> parse_unsigned(std::string_view text) {
  return parse_whole<std::uint64_t>(text);
}

void append_shortest(std::string& out, double value) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  out.append(digits.data(), end);
}

std::string shortest_text(double value) {
  std::string text;
  append_shortest(text, value);
  return text;
}

void append_integer(std::string& out, std::int64_t value) {
  std::array<char, 24> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  out.append(digits.data(), end);
}

void append_decimals(std::string& out, double value, int decimals) {
  constexpr std::array<std::int64_t, 10> kPowers = {
      1, 10, 100, 1'000, 10'000, 100'000, 1'000'000, 10'000'000, 100'000'000, 1'000'000'000};
  if (!std::isfinite(value)) return;
  const std::int64_t power = kPowers.at(static_cast<std::size_t>(decimals));
  const double scaled = value * static_cast<double>(power);
  if (std::abs(scaled) > 9e15) return append_shortest(out, value);  // beyond 2^53 every double is whole
  const std::int64_t number = std::llround(scaled);
  if (number < 0) out.push_back('-');
  // The digits of the whole number, with zeros ahead so that one stands before the point.
  std::array<char, 32> digits;
  digits.fill('0');
  char* const start = digits.data() + 10;
  const char* const end = std::to_chars(start, digits.data() + digits.size(), std::abs(number)).ptr;
  const char* const point = end - decimals;
  out.append(std::min<const char*>(start, point - 1), point);
  const std::string_view fraction(point, static_cast<std::size_t>(decimals));
  const std::size_t used = fraction.find_last_not_of('0') + 1;  // 0 where all are zeros
  if (used == 0) return;
  out.push_back('.');
  out.append(fraction.substr(0, used));
}

}  // namespace lightstripe
