// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/parsed_options.h"

#include <array>
#include <charconv>
#include <cmath>
#include <string>

#include "core/error.h"
#include "extraction/kernels/width_rule.h"

namespace lightstripe {
namespace {

/// Exactly N numbers with commas between them; nothing for any other text.
template <std::size_t N>
std::optional<std::array<double, N>> parse_numbers(const std::string& text) {
  std::array<double, N> numbers{};
  const char *at = text.data(), *end = at + text.size();
  for (std::size_t i = 0; i < N; ++i) {
    if (i > 0 && (at == end || *at++ != ',')) return std::nullopt;
    const auto [next, error] = std::from_chars(at, end, numbers[i]);
    if (error != std::errc{} || !std::isfinite(numbers[i])) return std::nullopt;
    at = next;
  }
  return at == end ? std::optional(numbers) : std::nullopt;
}

void parse_thresholds(const std::string& text, ParsedOptions& parsed) {
  if (text == "auto" || text == "bilevel") return;
  if (text == "otsu" || text == "rosin") {
    parsed.rule = text == "otsu" ? ThresholdRule::kOtsu : ThresholdRule::kRosin;
    return;
  }
  const auto pair = parse_numbers<2>(text);
  if (!pair || (*pair)[0] < 0 || (*pair)[1] < (*pair)[0])
    throw Error("thresholds", "'" + text + "' is not a pair of grey levels",
                "write auto, bilevel, otsu, rosin, or LOW,HIGH with 0 <= LOW <= HIGH");
  parsed.rule = ThresholdRule::kGiven;
  parsed.given = {(*pair)[0], (*pair)[1]};
}

std::optional<PixelRectangle> parse_roi(const std::string& text) {
  if (text.empty() || text == "all") return std::nullopt;
  const auto n = parse_numbers<4>(text);
  constexpr double kMost = 1e6;
  if (!n || (*n)[0] < 0 || (*n)[1] < 0 || (*n)[2] < 1 || (*n)[3] < 1 || (*n)[0] > kMost || (*n)[1] > kMost ||
      (*n)[2] > kMost || (*n)[3] > kMost)
    throw Error("roi", "'" + text + "' is not a rectangle", "write all, or X,Y,WIDTH,HEIGHT in pixels");
  const auto whole = [](double v) { return static_cast<int>(std::lround(v)); };
  return PixelRectangle{whole((*n)[0]), whole((*n)[1]), whole((*n)[2]), whole((*n)[3])};
}

std::optional<PixelPlace> parse_start(const std::string& text) {
  if (text.empty() || text == "none") return std::nullopt;
  const auto n = parse_numbers<2>(text);
  if (!n) throw Error("start", "'" + text + "' is not a place", "write none, or X,Y in pixels");
  return PixelPlace{(*n)[0], (*n)[1]};
}

void require(bool ok, const char* option, double value, const char* rule) {
  if (ok) return;
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  throw Error(option, "the value " + std::string(digits.data(), end) + " is out of range",
              std::string("give ") + rule);
}

void check_numbers(const ExtractionOptions& o) {
  const double largest_width = full_width_of(kLargestSigma);
  if (o.stripe_width)
    require(*o.stripe_width >= 1 && *o.stripe_width <= largest_width, "stripe_width", *o.stripe_width,
            "a full width of 1 to 69 px");
  if (o.sigma)
    require(*o.sigma >= kLeastSigma && *o.sigma <= kLargestSigma, "sigma", *o.sigma, "0.7 to 20 px");
  if (o.alpha) require(*o.alpha >= 0 && *o.alpha <= 1, "alpha", *o.alpha, "a weight of 0 to 1");
  require(o.beta >= 0 && o.beta <= 1, "beta", o.beta, "a weight of 0 to 1");
  require(o.max_lines >= 0, "max_lines", o.max_lines, "0 (all) or a number of lines");
  require(o.stop_after >= 0, "stop_after", o.stop_after, "0 (never) or a number of lines");
  require(o.lines.min_length >= 0, "lines.min_length", o.lines.min_length, "0 or more stripe widths");
  require(o.lines.max_width_ratio > 1, "lines.max_width_ratio", o.lines.max_width_ratio, "a ratio above 1");
  require(o.lines.spot_width_ratio > 1, "lines.spot_width_ratio", o.lines.spot_width_ratio,
          "a ratio above 1");
}

}  // namespace

ParsedOptions parse_options(const ExtractionOptions& options) {
  check_numbers(options);
  ParsedOptions parsed;
  parse_thresholds(options.thresholds, parsed);
  parsed.roi = parse_roi(options.roi);
  parsed.start = parse_start(options.start);
  return parsed;
}

}  // namespace lightstripe
