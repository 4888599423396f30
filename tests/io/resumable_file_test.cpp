// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/resumable_file.h"

#include <gmock/gmock.h>

#include "io/crc32.h"
#include "tests/io/temp_folder.h"

namespace lightstripe {
namespace {

using testing::HasSubstr;

TEST(Crc32, IsThatOfTheStandardAndGoesOnOverParts) {
  EXPECT_EQ(crc32("123456789"), 0xcbf43926U);  // the check value of CRC-32/ISO-HDLC
  EXPECT_EQ(crc32("56789", crc32("1234")), 0xcbf43926U);
  EXPECT_EQ(crc32(""), 0U);
}

TEST(ResumableFile, HasItsFinalNameOnlyWhenCommitted) {
  const TempFolder folder;
  ResumableFile file(folder / "a.ply", "head");
  file.append("one");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.ply"));
  EXPECT_EQ(content_of(folder / "a.partial.ply"), "headone");  // written through at once
  file.replace_head("HEAD");
  file.commit();
  EXPECT_EQ(content_of(folder / "a.ply"), "HEADone");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.partial.ply"));
}

TEST(ResumableFile, GoesOnBehindItsMark) {
  const TempFolder folder;
  ResumableFile::Mark mark;
  {
    ResumableFile file(folder / "a.csv", "head\n");
    file.append("one\n");
    mark = file.mark();
    file.append("two, cut o");  // killed here
  }
  ResumableFile file(folder / "a.csv", "head\n", mark);
  file.append("two\n");
  file.commit();
  EXPECT_EQ(content_of(folder / "a.csv"), "head\none\ntwo\n");
}

TEST(ResumableFile, RefusesAFileThatDoesNotHoldWhatTheMarkSays) {
  const TempFolder folder;
  const ResumableFile::Mark mark{3, crc32("one")};
  EXPECT_THAT(error_of([&] { ResumableFile(folder / "a.csv", "h", mark); }),
              HasSubstr("a.csv: cannot be written"));
  for (const std::string content : {"hon", "hOne", "h"}) {
    folder.write("a.partial.csv", content);
    EXPECT_THAT(error_of([&] { ResumableFile(folder / "a.csv", "h", mark); }),
                HasSubstr("does not hold what its journal says"));
  }
}

TEST(ResumableFile, DiscardLeavesNothing) {
  const TempFolder folder;
  ResumableFile file(folder / "sub/a.csv", "h");
  file.discard();
  EXPECT_TRUE(std::filesystem::is_empty(folder / "sub"));
}

TEST(ResumableFile, AFolderOfThatNameIsAnError) {
  const TempFolder folder;
  EXPECT_THAT(error_of([&] { ResumableFile(folder.path(), "h"); }), HasSubstr("is a folder"));
}

TEST(ResumableFile, AFilesBytesAreAppendedFromAPlaceOn) {
  const TempFolder folder;
  folder.write("part", "headline\n1\n2\n");
  ResumableFile file(folder / "whole.csv", "h\n");
  file.append_file(folder / "part", 9);
  file.append("3\n");
  file.append_file(folder / "part", 11);
  EXPECT_EQ(file.mark().bytes, 8);
  file.commit();
  EXPECT_EQ(content_of(folder / "whole.csv"), "h\n1\n2\n3\n2\n");
  ResumableFile other(folder / "other.csv", "h\n");
  EXPECT_THAT(error_of([&] { other.append_file(folder / "none", 0); }), HasSubstr("cannot be read"));
}

}  // namespace
}  // namespace lightstripe
