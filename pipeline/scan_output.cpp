// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/scan_output.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/tables.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;
using std::chrono::steady_clock;

/// Opened and locked, so that two runs never write the same files.
int open_journal(const fs::path& path) {
  std::error_code ignored;
  if (path.has_parent_path()) fs::create_directories(path.parent_path(), ignored);
  const int journal = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (journal < 0) cannot_write(path, errno);
  if (::flock(journal, LOCK_EX | LOCK_NB) == 0) return journal;
  ::close(journal);
  throw Error(path.string(), "another run writes these files", "wait for it, or name another output");
}

void put(int journal, const fs::path& path, std::string_view text) {
  if (::write(journal, text.data(), text.size()) != static_cast<ssize_t>(text.size()))
    cannot_write(path, errno);
}

/// The header counts the points that come behind it: it cannot be corrected in what has gone through a pipe.
void refuse_pipe(const fs::path& cloud, CloudFormat format) {
  std::error_code error;
  const fs::file_status status = fs::status(cloud, error);
  if (format != CloudFormat::kXyz && (fs::is_fifo(status) || fs::is_socket(status)))
    throw Error(cloud.string(), "is a pipe, and the cloud's header counts points that come behind it",
                "name a file, or write .xyz");
}

}  // namespace

ScanOutput::ScanOutput(const ScanOutputOptions& options)
    : options_(options),
      format_(cloud_format(options.cloud, options.cloud.string())),
      last_entry_(steady_clock::now()) {
  journal_ = open_journal(journal_path());
  try {
    if (!options_.resume || !go_on()) begin();
  } catch (...) {
    if (!has_entry_) {  // nothing that a later run could go on from
      if (cloud_) cloud_->discard();
      if (profiles_) profiles_->discard();
      forget_journal();
    }
    ::close(journal_);
    throw;
  }
}

ScanOutput::~ScanOutput() {
  if (!over_ && !has_entry_) discard();
  ::close(journal_);
}

fs::path ScanOutput::journal_path() const {
  return ResumableFile::partial_of(options_.cloud).replace_extension(".journal");
}

void ScanOutput::begin() {
  tally_.next_frame = options_.first_frame;
  if (::ftruncate(journal_, 0) != 0) cannot_write(journal_path(), errno);
  refuse_pipe(options_.cloud, format_);
  chain_ = 0;
  cloud_.emplace(options_.cloud, cloud_header(format_, 0, options_.origin));
  if (!options_.profiles.empty()) profiles_.emplace(options_.profiles, kProfilesHeader);
  put_line(journal_head(options_.fingerprint));
}

bool ScanOutput::go_on() {
  const auto state = read_journal(journal_path());
  if (!state) return false;
  if (state->fingerprint != options_.fingerprint)
    throw Error(journal_path().string(), "belongs to a run with other inputs or options",
                "run again without --resume");
  if (!state->has_entry) return false;
  if (::ftruncate(journal_, state->bytes) != 0)  // what was said of frames that are done again now
    cannot_write(journal_path(), errno);
  tally_ = state->tally;
  chain_ = state->chain;
  has_entry_ = true;
  was_complete_ = state->complete;
  if (was_complete_) {
    rename_what_is_left();
    return true;
  }
  cloud_.emplace(options_.cloud, cloud_header(format_, 0, options_.origin), state->cloud);
  if (!options_.profiles.empty()) profiles_.emplace(options_.profiles, kProfilesHeader, state->profiles);
  return true;
}

/// An earlier run was ended between its first rename and its last.
void ScanOutput::rename_what_is_left() {
  for (const fs::path& path : {options_.cloud, options_.profiles}) {
    if (path.empty() || !fs::exists(ResumableFile::partial_of(path))) continue;
    fs::rename(ResumableFile::partial_of(path), path);
  }
}

void ScanOutput::encode(ScannedFrame& frame) const {
  frame.encoded.resize(2);
  append_cloud_points(frame.encoded[0], format_, frame.profile, options_.origin);
  if (!options_.profiles.empty()) append_profile(frame.encoded[1], frame.profile);
}

void ScanOutput::append(const ScannedFrame& frame) {
  if (frame.counts.points > kMaxCloudPoints)
    throw Error(options_.cloud.string(), "the cloud exceeds " + std::to_string(kMaxCloudPoints) + " points",
                "reconstruct parts of the scan with --frames");
  cloud_->append(frame.encoded[0]);
  if (profiles_) profiles_->append(frame.encoded[1]);
  for (const SkippedPicture& picture : frame.skipped) {
    if (tally_.skipped.size() == ScanTally::kMaxNamed) break;
    tally_.skipped.push_back({frame.profile.frame, picture});
    put_line(journal_skip(tally_.skipped.back()));
  }
  tally_.next_frame = frame.profile.frame + 1;
  tally_.counts = frame.counts;
  if (steady_clock::now() - last_entry_ >= options_.checkpoint) write_entry();
}

void ScanOutput::put_line(const std::string& line) {
  put(journal_, journal_path(), sealed_line(line, chain_));
}

void ScanOutput::write_entry() {
  put_line(journal_entry(tally_, cloud_->mark(), profiles_ ? profiles_->mark() : ResumableFile::Mark{}));
  has_entry_ = true;
  last_entry_ = steady_clock::now();
}

void ScanOutput::keep() {
  cloud_->replace_head(cloud_header(format_, tally_.counts.points, options_.origin));
  write_entry();
  over_ = true;
}

void ScanOutput::commit() {
  over_ = true;
  if (was_complete_) return;
  cloud_->replace_head(cloud_header(format_, tally_.counts.points, options_.origin));
  write_entry();
  put_line(std::string(kJournalComplete));
  cloud_->commit();
  if (profiles_) profiles_->commit();
}

void ScanOutput::forget_journal() {
  std::error_code ignored;
  fs::remove(journal_path(), ignored);
}

void ScanOutput::discard() {
  over_ = true;
  if (cloud_) cloud_->discard();
  if (profiles_) profiles_->discard();
  forget_journal();
}

}  // namespace lightstripe
