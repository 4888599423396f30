// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/own_files.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "temp_folder.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;
constexpr const char* kMarker = ".ours";

TEST(OwnFiles, WhatWasClaimedIsOursInTheNextRunAndNothingElse) {
  const TempFolder folder;
  OwnFiles(folder.path(), kMarker).claim({"a/1.png", "b.csv"});
  folder.write("a/1.png", "ours");
  folder.write("a/2.png", "his");
  const OwnFiles own(folder.path(), kMarker);
  EXPECT_NO_THROW(own.refuse_foreign({"a/1.png", "b.csv", "new.csv"}));
  EXPECT_THROW(own.refuse_foreign({"a/1.png", "a/2.png"}), Error);
}

TEST(OwnFiles, WhatIsRemovedIsNoLongerOurs) {
  const TempFolder folder;
  OwnFiles own(folder.path(), kMarker);
  own.claim({"1.png", "2.png"});
  folder.write("2.png", "ours");
  own.remove("2.png");
  EXPECT_FALSE(fs::exists(folder / "2.png"));
  own.claim({"1.png"});
  folder.write("2.png", "his, later");
  EXPECT_THROW(OwnFiles(folder.path(), kMarker).refuse_foreign({"2.png"}), Error);
}

TEST(OwnFiles, WhatWasNotWrittenInTheEndIsGivenUp) {
  const TempFolder folder;
  OwnFiles own(folder.path(), kMarker);
  own.claim({"1.png", "2.png"});
  folder.write("1.png", "ours");
  own.release_missing();
  EXPECT_EQ(OwnFiles(folder.path(), kMarker).files(), std::set<std::string>{"1.png"});
  fs::remove(folder / "1.png");
  own.release_missing();
  EXPECT_FALSE(fs::exists(folder / kMarker));
}

TEST(OwnFiles, AMarkerThatWasTamperedWithNamesNothingOutside) {
  const TempFolder folder;
  folder.write(std::string("in/") + kMarker, "../his.txt\n/etc/passwd\nx/../../his.txt\nours.txt\n");
  const OwnFiles own(folder / "in", kMarker);
  EXPECT_EQ(own.files(), std::set<std::string>{"ours.txt"});
}

TEST(OwnFiles, ALinkThatDanglesIsSomebodysAsWell) {
  const TempFolder folder;
  fs::create_symlink(folder / "nowhere", folder / "b.csv");
  EXPECT_THROW(OwnFiles(folder.path(), kMarker).refuse_foreign({"b.csv"}), Error);
}

}  // namespace
}  // namespace lightstripe
