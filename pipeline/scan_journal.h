// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The lines of a reconstruction's journal, one a write: the run's fingerprint, skipped pictures, and entries
// that say up to where the files are complete.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/resumable_file.h"
#include "reconstruct/scanner.h"

namespace lightstripe {

struct NamedSkip {
  std::int64_t frame = 0;
  SkippedPicture picture;
};

/// What is in the files.
struct ScanTally {
  std::int64_t next_frame = 0;  ///< all before it are done
  ScanCounts counts;
  std::vector<NamedSkip> skipped;  ///< the first kMaxNamed
  static constexpr std::size_t kMaxNamed = 1000;
};

struct JournalState {
  std::string fingerprint;
  bool has_entry = false;
  bool complete = false;  ///< nothing is left but to rename
  ScanTally tally;
  ResumableFile::Mark cloud, profiles;
  std::uint32_t chain = 0;  ///< check sum of its lines up to there
  std::int64_t bytes = 0;   ///< of the journal up to and with its last entry
};

std::string journal_head(const std::string& fingerprint);
std::string journal_skip(const NamedSkip& skip);
std::string journal_entry(const ScanTally& tally, const ResumableFile::Mark& cloud,
                          const ResumableFile::Mark& profiles);
inline constexpr std::string_view kJournalComplete = "complete\n";
/// A line as it stands in the journal: with the check sum of all lines up to it, which `chain` goes on with.
std::string sealed_line(const std::string& line, std::uint32_t& chain);

/// The state of the last whole entry; a last line that was cut off does not count. Nothing where there is no
/// journal; an Error where the file is none, or a line is not the one that was written.
std::optional<JournalState> read_journal(const std::filesystem::path& path);

}  // namespace lightstripe
