// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/scan_journal.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/crc32.h"
#include "io/number_text.h"

namespace lightstripe {
namespace {

constexpr std::string_view kJournalHead = "lightstripe-journal/2 ";
constexpr std::size_t kEntryNumbers = 11;

/// Numbers between blanks; nothing where one is none or their number is another.
std::optional<std::array<std::int64_t, kEntryNumbers>> numbers_of(std::string_view text) {
  std::array<std::int64_t, kEntryNumbers> numbers{};
  for (std::size_t i = 0; i < kEntryNumbers; ++i) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const auto number = parse_integer(text.substr(0, end));
    if (!number) return std::nullopt;
    numbers[i] = *number;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return text.empty() ? std::optional(numbers) : std::nullopt;
}

/// "FRAME SENSOR reason".
std::optional<NamedSkip> skip_of(std::string_view text) {
  const std::size_t first = text.find(' '),
                    second = first == std::string_view::npos ? first : text.find(' ', first + 1);
  if (second == std::string_view::npos) return std::nullopt;
  const auto frame = parse_integer(text.substr(0, first)),
             sensor = parse_integer(text.substr(first + 1, second - first - 1));
  if (!frame || !sensor) return std::nullopt;
  return NamedSkip{*frame, {static_cast<int>(*sensor), std::string(text.substr(second + 1))}};
}

/// False where the line is no entry.
bool take_entry(std::string_view text, const std::vector<NamedSkip>& skips, JournalState& state) {
  const auto n = numbers_of(text);
  if (!n) return false;
  state.has_entry = true;
  state.tally.next_frame = (*n)[0];
  ScanCounts& counts = state.tally.counts;
  counts.frames = (*n)[1];
  counts.frames_without_points = (*n)[2];
  counts.points = (*n)[3];
  counts.rays_missed = (*n)[4];
  counts.pictures = (*n)[5];
  counts.pictures_skipped = (*n)[6];
  state.cloud = {(*n)[7], static_cast<std::uint32_t>((*n)[8])};
  state.profiles = {(*n)[9], static_cast<std::uint32_t>((*n)[10])};
  state.tally.skipped = skips;
  return true;
}

/// The line without its check sum, which has to be that of all lines up to it.
std::string_view unsealed(std::string_view line, std::uint32_t& chain, const std::filesystem::path& path) {
  constexpr std::size_t kSeal = 9;  // blank and 8 digits
  const std::string_view text = line.substr(0, line.size() - std::min(kSeal, line.size()));
  chain = crc32(text, chain);
  if (line.substr(text.size()) != fmt::format(" {:08x}", chain))
    throw Error(path.string(), "is no journal of a reconstruction, or was changed",
                "run again without --resume");
  return text;
}

}  // namespace

std::string sealed_line(const std::string& line, std::uint32_t& chain) {
  const std::string text = line.substr(0, line.find('\n'));
  chain = crc32(text, chain);
  return fmt::format("{} {:08x}\n", text, chain);
}

std::string journal_head(const std::string& fingerprint) {
  return fmt::format("{}{}\n", kJournalHead, fingerprint);
}

std::string journal_skip(const NamedSkip& skip) {
  std::string reason = skip.picture.reason;
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  return fmt::format("skipped {} {} {}\n", skip.frame, skip.picture.sensor, reason);
}

std::string journal_entry(const ScanTally& tally, const ResumableFile::Mark& cloud,
                          const ResumableFile::Mark& profiles) {
  const ScanCounts& s = tally.counts;
  return fmt::format("done {} {} {} {} {} {} {} {} {} {} {}\n", tally.next_frame, s.frames,
                     s.frames_without_points, s.points, s.rays_missed, s.pictures, s.pictures_skipped,
                     cloud.bytes, cloud.crc, profiles.bytes, profiles.crc);
}

std::optional<JournalState> read_journal(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  const std::string text = read_file(path);
  JournalState state;
  std::vector<NamedSkip> skips;
  std::uint32_t chain = 0;
  for (std::size_t at = 0, end; (end = text.find('\n', at)) != std::string::npos; at = end + 1) {
    const std::string_view line = unsealed(std::string_view(text).substr(at, end - at), chain, path);
    if (at == 0 && line.substr(0, kJournalHead.size()) == kJournalHead)
      state.fingerprint = line.substr(kJournalHead.size());
    else if (line == "complete")
      state.complete = true;
    else if (auto skip = line.substr(0, 8) == "skipped " ? skip_of(line.substr(8)) : std::nullopt)
      skips.push_back(std::move(*skip));
    else if (line.substr(0, 5) != "done " || !take_entry(line.substr(5), skips, state))
      throw Error(path.string(), "is no journal of a reconstruction", "run again without --resume");
    if (line.substr(0, 5) != "done " && !state.complete) continue;
    state.bytes = static_cast<std::int64_t>(end + 1);
    state.chain = chain;
  }
  if (state.fingerprint.empty()) return std::nullopt;  // killed before its first line
  return state;
}

}  // namespace lightstripe
