// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/number_text.h"

#include <array>
#include <charconv>
#include <cmath>

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
  std::int64_t number = std::llround(scaled);
  if (number < 0) {
    out.push_back('-');
    number = -number;
  }
  append_integer(out, number / power);
  std::int64_t fraction = number % power;
  if (fraction == 0) return;
  std::array<char, 10> digits{'.'};
  std::size_t used = 1;
  for (std::int64_t place = power / 10; fraction != 0; place /= 10) {
    digits.at(used++) = static_cast<char>('0' + fraction / place);
    fraction %= place;
  }
  out.append(digits.data(), used);
}

}  // namespace lightstripe
