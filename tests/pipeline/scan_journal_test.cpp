// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/scan_journal.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "io/atomic_file.h"
#include "tests/io/temp_folder.h"

namespace lightstripe {
namespace {

/// Two entries behind a head.
std::string whole_journal() {
  std::uint32_t chain = 0;
  ScanTally tally;
  std::string text = sealed_line(journal_head("abc"), chain);
  for (int frame = 1; frame <= 2; ++frame) {
    tally.next_frame = frame;
    tally.counts.points = 100 * frame;
    text += sealed_line(journal_entry(tally, {1000 * frame, 7}, {}), chain);
  }
  return text;
}

TEST(ScanJournal, IsReadAsItWasWritten) {
  const TempFolder folder;
  const auto state = read_journal(folder.write("j", whole_journal()));
  ASSERT_TRUE(state);
  EXPECT_EQ(state->fingerprint, "abc");
  EXPECT_EQ(state->tally.next_frame, 2);
  EXPECT_EQ(state->tally.counts.points, 200);
  EXPECT_EQ(state->cloud.bytes, 2000);
}

TEST(ScanJournal, ALineThatWasCutOffDoesNotCount) {
  const TempFolder folder;
  const std::string text = whole_journal();
  const auto state = read_journal(folder.write("j", text.substr(0, text.size() - 5)));
  ASSERT_TRUE(state);
  EXPECT_EQ(state->tally.next_frame, 1);
}

TEST(ScanJournal, EveryChangedByteIsSeen) {
  const TempFolder folder;
  const std::string text = whole_journal();
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    if (text[i] == '\n') continue;
    std::string changed = text;
    changed[i] = changed[i] == '1' ? '2' : '1';
    EXPECT_THROW(read_journal(folder.write("j", changed)), Error) << "byte " << i;
  }
}

TEST(ScanJournal, ALineThatIsMissingOrTwiceIsSeen) {
  const TempFolder folder;
  const std::string text = whole_journal();
  const std::size_t first = text.find('\n') + 1, second = text.find('\n', first) + 1;
  EXPECT_THROW(read_journal(folder.write("j", text.substr(0, first) + text.substr(second))), Error);
  EXPECT_THROW(read_journal(folder.write("j", text + text.substr(second))), Error);
}

}  // namespace
}  // namespace lightstripe
