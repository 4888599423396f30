// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/atomic_file.h"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <thread>

#include "tests/io/temp_folder.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::size_t number_of_entries(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(AtomicFile, AppearsOnlyByCommit) {
  const TempFolder folder;
  {
    AtomicFile file(folder / "new/deep/cloud.ply");
    EXPECT_EQ(file.temporary().parent_path(), folder / "new/deep");
    EXPECT_EQ(file.temporary().extension(), ".ply");
    std::ofstream(file.temporary()) << "points";
    EXPECT_FALSE(fs::exists(folder / "new/deep/cloud.ply"));
    file.commit();
  }
  EXPECT_EQ(content_of(folder / "new/deep/cloud.ply"), "points");
  EXPECT_EQ(number_of_entries(folder / "new/deep"), 1U);
}

TEST(AtomicFile, DroppedLeavesTheOldFileAndNothingElse) {
  const TempFolder folder;
  folder.write("a.txt", "old");
  {
    const AtomicFile file(folder / "a.txt");
    std::ofstream(file.temporary()) << "half";
  }
  EXPECT_EQ(content_of(folder / "a.txt"), "old");
  EXPECT_EQ(number_of_entries(folder.path()), 1U);
}

TEST(AtomicFile, TwoForTheSameNameDoNotShareATemporary) {
  const TempFolder folder;
  const AtomicFile a(folder / "a.txt"), b(folder / "a.txt");
  EXPECT_NE(a.temporary(), b.temporary());
}

TEST(AtomicFile, RefusesAFolderAndAFileInTheWay) {
  const TempFolder folder;
  folder.write("file", "x");
  EXPECT_THAT(error_of([&] { AtomicFile file(folder.path()); }), HasSubstr("is a folder"));
  EXPECT_THAT(error_of([&] { AtomicFile file(folder.path() / ""); }), HasSubstr("is a folder"));
  EXPECT_THAT(error_of([&] { AtomicFile file(folder / "file/inside.txt"); }),
              HasSubstr("cannot make the folder"));
  EXPECT_THAT(error_of([&] { AtomicFile file("/proc/none.txt"); }),
              HasSubstr("/proc/none.txt: cannot be written"));
}

TEST(AtomicFile, KeepsASymbolicLink) {
  const TempFolder folder;
  folder.write("target.txt", "old");
  fs::create_symlink(folder / "target.txt", folder / "link.txt");
  write_file(folder / "link.txt", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link.txt"));
  EXPECT_EQ(content_of(folder / "target.txt"), "new");
}

TEST(WriteFile, WritesABareNameInTheWorkingFolder) {
  const TempFolder folder;
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());
  write_file("bare.txt", "text");
  fs::current_path(before);
  EXPECT_EQ(content_of(folder / "bare.txt"), "text");
}

TEST(WriteFile, AFullDeviceIsAnErrorAndStaysADevice) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  EXPECT_THAT(error_of([] { write_file("/dev/full", "text"); }),
              HasSubstr("/dev/full: cannot be written (No space left"));
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST(WriteFile, AnInterruptedWriteLeavesTheOldFileAndNothingElse) {
  const TempFolder folder;
  folder.write("a.txt", "old");
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{1000, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string message = error_of([&] { write_file(folder / "a.txt", std::string(5000, 'x')); });
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  EXPECT_THAT(message, HasSubstr("a.txt: cannot be written"));
  EXPECT_EQ(content_of(folder / "a.txt"), "old");
  EXPECT_EQ(number_of_entries(folder.path()), 1U);
}

TEST(WriteFile, APipeIsWrittenToItsReaderAndNeverWaitedFor) {
  const TempFolder folder;
  const fs::path pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  try {
    write_file(pipe, "text");
    FAIL() << "nobody reads it";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("is a pipe that nobody reads"));
  }
  std::string got;
  std::thread reader([&] {
    std::ifstream in(pipe);
    got.assign(std::istreambuf_iterator<char>(in), {});
  });
  write_file(pipe, "text");
  reader.join();
  EXPECT_EQ(got, "text");
}

TEST(ReadFile, GivesBackWhatWasWritten) {
  const TempFolder folder;
  const std::string text = std::string("a\0b\r\n", 5) + std::string(200'000, 'z');
  write_file(folder / "with space äöü.bin", text);
  EXPECT_EQ(read_file(folder / "with space äöü.bin"), text);
  EXPECT_THAT(error_of([&] { read_file(folder / "with space äöü.bin", 1000); }),
              HasSubstr("limit of 1000 bytes"));
}

TEST(ReadFile, ExplainsWhatCannotBeRead) {
  const TempFolder folder;
  EXPECT_THAT(error_of([&] { read_file(folder / "none"); }), HasSubstr("none: cannot be read (No such file"));
  EXPECT_THAT(error_of([&] { read_file(folder.path()); }), HasSubstr("is a folder"));
}

}  // namespace
}  // namespace lightstripe
