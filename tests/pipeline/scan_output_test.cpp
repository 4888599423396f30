// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/scan_output.h"

#include <gmock/gmock.h>

#include "core/error.h"
#include "io/atomic_file.h"
#include "pipeline/scan_journal.h"
#include "tests/io/temp_folder.h"

namespace lightstripe {
namespace {

using ::testing::HasSubstr;

/// A frame of as many points as its number, with the counts that the scanner gives it.
ScannedFrame frame_of(std::int64_t number, ScanCounts& counts) {
  ScannedFrame frame;
  frame.profile.frame = number;
  frame.profile.points.resize(static_cast<std::size_t>(number));
  frame.pictures = 1;
  ++counts.frames, ++counts.pictures, counts.points += number;
  frame.counts = counts;
  return frame;
}

class ScanOutputFiles : public ::testing::Test {
 protected:
  ScanOutputOptions options(const std::string& fingerprint = "abc", bool resume = false) const {
    ScanOutputOptions options;
    options.cloud = folder_.path() / "cloud.ply";
    options.profiles = folder_.path() / "profiles.csv";
    options.fingerprint = fingerprint;
    options.resume = resume;
    options.checkpoint = std::chrono::milliseconds(0);  // an entry a frame
    return options;
  }

  static void write(ScanOutput& output, std::int64_t first, std::int64_t end) {
    ScanCounts counts = output.tally().counts;
    for (std::int64_t i = first; i < end; ++i) {
      ScannedFrame frame = frame_of(i, counts);
      output.encode(frame);
      output.append(frame);
    }
  }

  TempFolder folder_;
};

TEST_F(ScanOutputFiles, FilesAppearAtTheCommit) {
  ScanOutput output(options());
  write(output, 0, 4);
  EXPECT_FALSE(std::filesystem::exists(options().cloud));
  output.commit();
  output.forget_journal();
  EXPECT_THAT(read_file(options().cloud), HasSubstr("element vertex 6\n"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 2);
}

TEST_F(ScanOutputFiles, GoesOnBehindTheLastEntryWithItsCounts) {
  {
    ScanOutput killed(options());
    write(killed, 0, 3);
  }
  ScanOutput resumed(options("abc", true));
  EXPECT_EQ(resumed.tally().next_frame, 3);
  EXPECT_EQ(resumed.tally().counts.points, 3);
  EXPECT_EQ(resumed.tally().counts.frames, 3);
  write(resumed, 3, 4);
  resumed.commit();
  EXPECT_THAT(read_file(options().cloud), HasSubstr("element vertex 6\n"));
}

TEST_F(ScanOutputFiles, RefusesToGoOnWithAnotherRun) {
  {
    ScanOutput killed(options());
    write(killed, 0, 3);
  }
  EXPECT_THROW((ScanOutput{options("other", true)}), Error);
}

TEST_F(ScanOutputFiles, TwoRunsDoNotWriteTheSameFiles) {
  const ScanOutput first(options());
  EXPECT_THROW(ScanOutput{options()}, Error);
}

TEST(ScanJournal, ALastLineThatWasCutOffDoesNotCount) {
  const TempFolder folder;
  const auto path = folder.path() / "j";
  ScanTally tally;
  tally.next_frame = 7;
  tally.counts = {7, 1, 70, 2, 14, 1};
  std::uint32_t chain = 0;
  std::string whole;
  for (const std::string& line : {journal_head("f00"), journal_skip({3, {1, "damaged\npicture"}}),
                                  journal_entry(tally, {100, 5}, {200, 6})})
    whole += sealed_line(line, chain);
  write_file(path, whole + "done 9 9 0 9");
  const auto state = read_journal(path);
  ASSERT_TRUE(state && state->has_entry);
  EXPECT_EQ(state->fingerprint, "f00");
  EXPECT_EQ(state->tally.next_frame, 7);
  EXPECT_EQ(state->tally.counts.points, 70);
  EXPECT_EQ(state->tally.counts.pictures_skipped, 1);
  ASSERT_EQ(state->tally.skipped.size(), 1U);
  EXPECT_EQ(state->tally.skipped[0].picture.reason, "damaged picture");
  EXPECT_EQ(state->bytes, static_cast<std::int64_t>(whole.size()));
  EXPECT_FALSE(read_journal(folder.path() / "none"));
  write_file(path, "something else\n");
  EXPECT_THROW(read_journal(path), Error);
}

}  // namespace
}  // namespace lightstripe
