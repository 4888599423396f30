// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/frame_numbers.h"

#include <fmt/format.h>
#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>

#include "core/counted.h"
#include "core/error.h"
#include "io/name_numbers.h"
#include "io/number_text.h"

namespace lightstripe {
namespace {

using Numbers = std::vector<std::int64_t>;

constexpr const char* kDigits = "0123456789";
constexpr std::int64_t kSparse = 2;  // frames a picture; beyond, the numbers are no running numbers

/// A name around its last run of digits, the extension left out.
struct NameParts {
  std::string_view before, behind;
  std::optional<std::int64_t> number;
};

NameParts parts_of(std::string_view name) {
  const std::string_view stem = name.substr(0, name.rfind('.'));
  const std::size_t last = stem.find_last_of(kDigits);
  if (last == std::string_view::npos) return {};
  const std::size_t before = stem.find_last_not_of(kDigits, last);
  std::size_t first = before == std::string_view::npos ? 0 : before + 1;
  if (is_minus_sign(stem, before)) first = before;
  return {stem.substr(0, first), stem.substr(last + 1), parse_integer(stem.substr(first, last + 1 - first))};
}

/// The numbers of each source's pictures; nothing where one of the sources has none.
std::optional<std::vector<Numbers>> all_numbers(std::span<const FrameSource* const> sources) {
  std::vector<Numbers> numbers(sources.size());
  for (std::size_t s = 0; s < sources.size(); ++s)
    for (std::int64_t i = 0; sources[s] != nullptr && i < sources[s]->size(); ++i) {
      const auto number = sources[s]->number(i);
      if (!number) return std::nullopt;
      numbers[s].push_back(*number);
    }
  return numbers;
}

/// Frames from running numbers: (number - base) / step.
struct Numbering {
  std::int64_t base = 0, step = 1;
};

/// Counted from the lowest number in steps of the largest common one; nothing where that leaves most frames
/// empty.
std::optional<Numbering> from_lowest(const std::vector<Numbers>& numbers) {
  std::int64_t low = std::numeric_limits<std::int64_t>::max(), high = 0, most = 0, step = 0;
  for (const Numbers& of_source : numbers) {
    most = std::max(most, static_cast<std::int64_t>(of_source.size()));
    for (const std::int64_t n : of_source) {
      low = std::min(low, n);
      high = std::max(high, n);
    }
  }
  for (const Numbers& of_source : numbers)
    for (const std::int64_t n : of_source) step = std::gcd(step, n - low);
  step = std::max<std::int64_t>(step, 1);
  if ((high - low) / step + 1 > kSparse * most) return std::nullopt;
  return Numbering{low, step};
}

/// How many frames have a picture and no position, or a position and no picture. Both sorted.
std::size_t misfit(const std::vector<Numbers>& numbers, const Numbering& numbering,
                   const Numbers& positions) {
  Numbers frames;
  for (const Numbers& of_source : numbers)
    for (const std::int64_t n : of_source) frames.push_back((n - numbering.base) / numbering.step);
  std::sort(frames.begin(), frames.end());
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  Numbers apart;
  std::set_symmetric_difference(frames.begin(), frames.end(), positions.begin(), positions.end(),
                                std::back_inserter(apart));
  return apart.size();
}

bool fits_32_bits(const std::vector<Numbers>& numbers) {
  constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
  for (const Numbers& of_source : numbers)
    for (const std::int64_t n : of_source)
      if (n < 0 || n >= kMost) return false;
  return true;
}

std::optional<Numbering> choose_numbering(const std::vector<Numbers>& numbers, const Numbers& positions) {
  const auto counted = from_lowest(numbers);
  if (!counted || positions.empty() || !fits_32_bits(numbers)) return counted;
  const Numbering as_they_stand;
  return misfit(numbers, as_they_stand, positions) <= misfit(numbers, *counted, positions) ? as_they_stand
                                                                                           : *counted;
}

/// Sources of one length, each without a gap or a doubled number in the same steps, that begin apart.
bool start_apart_without_gap(const std::vector<Numbers>& numbers) {
  const Numbers* first = nullptr;
  bool apart = false;
  for (const Numbers& of_source : numbers) {
    if (of_source.empty()) continue;
    const std::int64_t step = of_source.size() > 1 ? of_source[1] - of_source[0] : 0;
    if (step <= 0) return false;
    for (std::size_t i = 1; i < of_source.size(); ++i)
      if (of_source[i] - of_source[i - 1] != step) return false;
    if (first == nullptr) first = &of_source;
    if (of_source.size() != first->size() || step != (*first)[1] - (*first)[0]) return false;
    apart = apart || of_source.front() != first->front();
  }
  return apart;
}

/// Whether two sources have other numbers.
bool differ(const std::vector<Numbers>& numbers) {
  const Numbers* first = nullptr;
  for (const Numbers& of_source : numbers) {
    if (of_source.empty()) continue;
    if (first != nullptr && *first != of_source) return true;
    first = &of_source;
  }
  return false;
}

/// Whether the order fits the travel table at least as well as the numbers do.
bool order_fits_better(const std::vector<Numbers>& numbers, const Numbers& positions) {
  if (positions.empty()) return true;
  Numbers order;
  for (const Numbers& of_source : numbers) order.resize(std::max(order.size(), of_source.size()));
  std::iota(order.begin(), order.end(), 0);
  const auto by_numbers = choose_numbering(numbers, positions);
  return !by_numbers || misfit({order}, {}, positions) <= misfit(numbers, *by_numbers, positions);
}

/// The numbers of the pictures in order, where the table's span most of them and they are far from running
/// numbers: time stamps.
Numbers stamps_of(const std::vector<Numbers>& numbers, const Numbers& positions) {
  for (const Numbers& of_source : numbers) {
    if (of_source.empty()) continue;
    if (positions.empty() || !std::is_sorted(of_source.begin(), of_source.end())) return {};
    const auto within = std::count_if(of_source.begin(), of_source.end(), [&](std::int64_t n) {
      return n >= positions.front() && n <= positions.back();
    });
    return 2 * within >= static_cast<std::ptrdiff_t>(of_source.size()) ? of_source : Numbers{};
  }
  return {};
}

/// Numbers in steps of their own size (stamps of an exact clock): the table's are of their kind, so they are
/// looked up, not counted.
bool is_time_stamps(const std::vector<Numbers>& numbers, const Numbering& numbering,
                    const Numbers& positions) {
  return !fits_32_bits(numbers) && numbering.base != 0 && !positions.empty() &&
         !stamps_of(numbers, positions).empty();
}

/// Sets map.index; `place_of` tells how many frames a number lies behind the map's first one.
template <class PlaceOf>
void index_pictures(std::span<const FrameSource* const> sources, const std::vector<Numbers>& numbers,
                    std::size_t num_frames, const PlaceOf& place_of, FrameMap& map) {
  map.index.assign(numbers.size(), std::vector<std::int32_t>(num_frames, -1));
  for (std::size_t s = 0; s < numbers.size(); ++s)
    for (std::size_t i = 0; i < numbers[s].size(); ++i) {
      std::int32_t& index = map.index[s][static_cast<std::size_t>(place_of(numbers[s][i]))];
      if (index >= 0)
        map.duplicate_pictures.push_back(sources[s]->name(static_cast<std::int64_t>(i)));
      else
        index = static_cast<std::int32_t>(i);
    }
}

FrameMap by_number(std::span<const FrameSource* const> sources, const std::vector<Numbers>& numbers,
                   const Numbering& numbering) {
  const auto frame_of = [&](std::int64_t n) { return (n - numbering.base) / numbering.step; };
  FrameMap map;
  map.number_step = numbering.step;
  map.first = std::numeric_limits<std::int64_t>::max();
  for (const Numbers& of_source : numbers)
    for (const std::int64_t n : of_source) {
      map.first = std::min(map.first, frame_of(n));
      map.end = std::max(map.end, frame_of(n) + 1);
    }
  const auto place_of = [&](std::int64_t n) { return frame_of(n) - map.first; };
  index_pictures(sources, numbers, static_cast<std::size_t>(map.end - map.first), place_of, map);
  return map;
}

FrameMap by_order(std::span<const FrameSource* const> sources, const std::string& subject) {
  FrameMap map;
  for (const FrameSource* source : sources) {
    if (source == nullptr) continue;
    if (map.end != 0 && source->size() != map.end)
      throw Error(subject,
                  fmt::format("one sensor has {}, another {}", counted(map.end, "frame"), source->size()),
                  "give every sensor the same frames, so that the n-th of each belong together, or number "
                  "the files through");
    map.end = source->size();
  }
  map.index.resize(sources.size());
  for (std::size_t s = 0; s < sources.size(); ++s) {
    map.index[s].assign(static_cast<std::size_t>(map.end), -1);
    if (sources[s] != nullptr) std::iota(map.index[s].begin(), map.index[s].end(), 0);
  }
  return map;
}

/// All sources' stamps in order; nothing where the cameras' clocks do not agree on most of them.
Numbers common_stamps(const std::vector<Numbers>& numbers) {
  Numbers all;
  std::size_t most = 0;
  for (const Numbers& of_source : numbers) {
    all.insert(all.end(), of_source.begin(), of_source.end());
    most = std::max(most, of_source.size());
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return 2 * all.size() <= 3 * most ? all : Numbers{};
}

/// One frame for each stamp, with the pictures that have it.
FrameMap by_stamp(std::span<const FrameSource* const> sources, const std::vector<Numbers>& numbers,
                  Numbers stamps) {
  FrameMap map;
  map.end = static_cast<std::int64_t>(stamps.size());
  const auto place_of = [&](std::int64_t stamp) {
    return std::lower_bound(stamps.begin(), stamps.end(), stamp) - stamps.begin();
  };
  index_pictures(sources, numbers, stamps.size(), place_of, map);
  map.stamps = std::move(stamps);
  return map;
}

}  // namespace

std::vector<std::int64_t> numbers_in_names(const std::vector<std::string>& names) {
  Numbers numbers;
  numbers.reserve(names.size());
  if (names.empty()) return numbers;
  const NameParts first = parts_of(names.front());
  for (const std::string& name : names) {
    const NameParts parts = parts_of(name);
    if (!parts.number || parts.before != first.before || parts.behind != first.behind) return {};
    numbers.push_back(*parts.number);
  }
  return numbers;
}

FrameMap map_frames(std::span<const FrameSource* const> sources, const std::vector<std::int64_t>& positions,
                    const std::string& subject) {
  const auto numbers = all_numbers(sources);
  if (!numbers) return by_order(sources, subject);
  if (start_apart_without_gap(*numbers) && order_fits_better(*numbers, positions)) {
    FrameMap map = by_order(sources, subject);
    map.paired_by_order = true;
    return map;
  }
  if (const auto numbering = choose_numbering(*numbers, positions))
    if (!is_time_stamps(*numbers, *numbering, positions)) return by_number(sources, *numbers, *numbering);
  if (!stamps_of(*numbers, positions).empty())
    if (Numbers stamps = common_stamps(*numbers); !stamps.empty())
      return by_stamp(sources, *numbers, std::move(stamps));
  FrameMap map = by_order(sources, subject);
  map.stamps = stamps_of(*numbers, positions);
  map.paired_by_order = differ(*numbers);
  return map;
}

}  // namespace lightstripe
