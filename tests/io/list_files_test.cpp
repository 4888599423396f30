// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "io/images.h"
#include "tests/io/temp_folder.h"

namespace lightstripe {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> names(const TempFolder& folder, const std::string& pattern) {
  std::vector<std::string> out;
  for (const auto& file : list_files(folder.path(), pattern)) out.push_back(file.filename().string());
  return out;
}

TEST(NaturalLess, ComparesRunsOfDigitsAsNumbers) {
  EXPECT_TRUE(natural_less("img_2", "img_10"));
  EXPECT_FALSE(natural_less("img_10", "img_2"));
  EXPECT_TRUE(natural_less("a2b10", "a2b11"));
  EXPECT_TRUE(natural_less("007", "10"));
  EXPECT_TRUE(natural_less("x_-10", "x_-5"));
  EXPECT_TRUE(natural_less("x_-5", "x_3"));
  EXPECT_TRUE(natural_less("-5.png", "0.png"));
  EXPECT_TRUE(natural_less("img-5", "img-10")) << "a hyphen is no sign";
  EXPECT_FALSE(natural_less("0010", "9"));
  EXPECT_TRUE(natural_less("a", "a1"));
  EXPECT_TRUE(natural_less("9", "a"));
  EXPECT_TRUE(natural_less("99999999999999999999998", "99999999999999999999999"));
  EXPECT_FALSE(natural_less("x", "x"));
  EXPECT_NE(natural_less("a01", "a1"), natural_less("a1", "a01"));
}

TEST(NaturalLess, IsAStrictOrder) {
  const std::vector<std::string> texts = {"",   "0",   "00",   "1",   "01",   "1a",  "01a",
                                          "-1", "_-1", "_-01", "_-2", "_1",   "_-",  "-0",
                                          "a",  "a0",  "a00",  "a1",  "a01b", "a1b", "b"};
  for (const auto& a : texts)
    for (const auto& b : texts) {
      if (a != b) {
        EXPECT_NE(natural_less(a, b), natural_less(b, a)) << a << " " << b;
      }
      for (const auto& c : texts) {
        if (natural_less(a, b) && natural_less(b, c)) {
          EXPECT_TRUE(natural_less(a, c)) << a << " " << b << " " << c;
        }
      }
    }
}

TEST(ListFiles, GivesMatchesInNaturalOrder) {
  const TempFolder folder;
  for (const char* name : {"c/img_10.png", "c/img_2.png", "c/img_1.jpg", "c/.img_3.png", "c/img_x/a.png"})
    folder.write(name, "x");
  EXPECT_THAT(names(folder, "c/img_*.png"), ElementsAre("img_2.png", "img_10.png"));
  EXPECT_THAT(names(folder, "c/img_?.*"), ElementsAre("img_1.jpg", "img_2.png"));
  EXPECT_THAT(names(folder, "c/img_2.png"), ElementsAre("img_2.png"));
  EXPECT_EQ(list_files(folder.path(), "c/*.jpg").front(), folder / "c/img_1.jpg");
  EXPECT_EQ(list_files("/nowhere", (folder / "c/*.jpg").string()).front(), folder / "c/img_1.jpg");
}

TEST(ListFiles, TakesSpacesAndUtf8) {
  const TempFolder folder;
  folder.write("mein Ordner/Prüfkörper ä 1.png", "x");
  EXPECT_THAT(names(folder, "mein Ordner/Prüfkörper ? *.png"), ElementsAre("Prüfkörper ä 1.png"));
}

TEST(ListFiles, TellsAMissingFolderFromNoMatch) {
  const TempFolder folder;
  folder.write("c/a.png", "x");
  EXPECT_EQ(error_of([&] { list_files(folder.path(), "d/*.png"); }),
            (folder / "d").string() + ": no such folder; check the path");
  EXPECT_EQ(error_of([&] { list_files(folder.path(), "c/*.jpg"); }),
            (folder / "c/*.jpg").string() + ": no file matches; check the pattern");
  EXPECT_THAT(error_of([&] { list_files(folder.path(), "c/b.png"); }), HasSubstr("c/b.png: no such file"));
}

TEST(ListFiles, RefusesFoldersAndStarsInFolders) {
  const TempFolder folder;
  folder.write("c/a.png", "x");
  EXPECT_THAT(error_of([&] { list_files(folder.path(), "c"); }), HasSubstr("is a folder; say which files"));
  EXPECT_THAT(error_of([&] { list_files(folder.path(), "*/a.png"); }),
              HasSubstr("has a * or ? in a folder's name"));
}

TEST(ListFiles, ManyStarsTakeNoTime) {
  const TempFolder folder;
  folder.write(std::string(200, 'a'), "x");
  std::string pattern;
  for (int i = 0; i < 60; ++i) pattern += "a*";
  EXPECT_THAT(error_of([&] { list_files(folder.path(), pattern + "b"); }), HasSubstr("no file matches"));
}

TEST(MatchedText, IsWhatTheStarStandsFor) {
  EXPECT_EQ(matched_text("calib/board_*.png", "/x/board_007.png"), "007");
  EXPECT_EQ(matched_text("*.png", "007.png"), "007");
  EXPECT_EQ(matched_text("*", "a.b"), "a.b");
  EXPECT_EQ(matched_text("p*", "p"), "");
  EXPECT_EQ(matched_text("one.png", "one.png"), "");
  EXPECT_EQ(matched_text("a*b*.png", "a1b2.png"), "1b2");
  EXPECT_THROW(matched_text("board_*.png", "laser_1.png"), std::logic_error);
}

}  // namespace
}  // namespace lightstripe
