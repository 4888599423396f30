// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The files of a reconstruction while it runs: cloud and sections grow beside their final names, and a
// journal
// (<cloud's stem>.partial.journal) tells up to where both are complete, so that a run that was stopped,
// killed or has failed can go on where it was and end in the same bytes.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "io/resumable_file.h"
#include "pipeline/scan_journal.h"
#include "reconstruct/cloud_header.h"
#include "reconstruct/scanner.h"

namespace lightstripe {

struct ScanOutputOptions {
  std::filesystem::path cloud;
  std::filesystem::path profiles;  ///< empty: none
  std::int64_t first_frame = 0;
  CloudOrigin origin = CloudOrigin::Zero();
  std::string fingerprint;  ///< of everything that the bytes depend on
  bool resume = false;
  std::chrono::milliseconds checkpoint{1000};
};

class ScanOutput {
 public:
  /// With `resume` goes on behind the journal's last entry, if there is a journal; an Error where that
  /// belongs to another run, or a run under way writes the same files.
  explicit ScanOutput(const ScanOutputOptions& options);
  /// Drops the files, unless they were committed, kept, or a journal entry makes them worth to go on from.
  ~ScanOutput();
  ScanOutput(const ScanOutput&) = delete;
  ScanOutput& operator=(const ScanOutput&) = delete;

  /// The bytes of a frame, for ScanInput::encode.
  void encode(ScannedFrame& frame) const;
  void append(const ScannedFrame& frame);
  const ScanTally& tally() const { return tally_; }
  std::filesystem::path partial_cloud() const { return ResumableFile::partial_of(options_.cloud); }

  /// The files as they are become readable under their partial names, and are kept.
  void keep();
  /// The files take their final names. The journal stays until forget_journal(), for what else has to be
  /// written beside them.
  void commit();
  void forget_journal();
  /// Nothing is left of the files.
  void discard();
  /// Whether the journal says that an earlier run had come to commit().
  bool was_complete() const { return was_complete_; }

 private:
  void begin();
  bool go_on();
  void rename_what_is_left();
  void write_entry();
  void put_line(const std::string& line);
  std::filesystem::path journal_path() const;

  ScanOutputOptions options_;
  CloudFormat format_;
  ScanTally tally_;
  std::optional<ResumableFile> cloud_, profiles_;
  int journal_ = -1;
  std::uint32_t chain_ = 0;  ///< check sum of the journal's lines so far
  bool has_entry_ = false;   ///< the journal holds more than its first line
  bool over_ = false;
  bool was_complete_ = false;
  std::chrono::steady_clock::time_point last_entry_;
};

}  // namespace lightstripe
