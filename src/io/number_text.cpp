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

namespace {

/// As llround, for values below 2^53.
std::int64_t rounded(double value) {
  const auto whole = static_cast<std::int64_t>(value);
  const double rest = value - static_cast<double>(whole);  // exact
  return whole + (rest >= 0.5 ? 1 : 0) - (rest <= -0.5 ? 1 : 0);
}

/// Writes the digits of `value` before `end`, at least `least` of them, and returns the first.
char* write_digits(std::uint64_t value, int least, char* end) {
  char* at = end;
  for (; value > 0 || end - at < least; value /= 10) *--at = static_cast<char>('0' + value % 10);
  return at;
}

}  // namespace

void append_decimals(std::string& out, double value, int decimals) {
  constexpr std::array<std::int64_t, 10> kPowers = {
      1, 10, 100, 1'000, 10'000, 100'000, 1'000'000, 10'000'000, 100'000'000, 1'000'000'000};
  if (!std::isfinite(value)) return;
  const std::int64_t power = kPowers.at(static_cast<std::size_t>(decimals));
  const double scaled = value * static_cast<double>(power);
  if (std::abs(scaled) > 9e15) return append_shortest(out, value);  // beyond 2^53 every double is whole
  const std::int64_t number = rounded(scaled);
  auto digits = static_cast<std::uint64_t>(number < 0 ? -number : number);
  int places = decimals;
  for (; places > 0 && digits % 10 == 0; --places) digits /= 10;
  // The text grows from its end: one append costs less than four.
  std::array<char, 32> text;
  char* const end = text.data() + text.size();
  char* first = end;
  if (places > 0) {
    const std::uint64_t scale = static_cast<std::uint64_t>(kPowers[static_cast<std::size_t>(places)]);
    first = write_digits(digits % scale, places, end);
    *--first = '.';
    digits /= scale;
  }
  first = write_digits(digits, 1, first);
  if (number < 0) *--first = '-';
  out.append(first, end);
}

}  // namespace lightstripe
