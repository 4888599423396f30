// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Real, labelled pictures beside the project's folder, default options: how many are complete, and how many
// have false lines, by the rules of score.py beside them. Left out where they are not there.
#include <gtest/gtest.h>

#include <filesystem>
#include <string_view>

#include "extraction/extract_stripes.h"
#include "io/images.h"
#include "report/line_labels.h"
#include "test_paths.h"
#include "truth/other_cameras.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

struct Score {
  int lit = 0, complete = 0, missed = 0, with_false = 0;

  void add(const LabelledPicture& picture, const Image8& image) {
    const LabelScore s = score_lines(picture.lines, extract_stripes(image.view()).stripes);
    lit += s.has_laser() ? 1 : 0;
    complete += s.has_laser() && s.complete() ? 1 : 0;
    missed += s.has_laser() && s.cover() < 0.05 ? 1 : 0;
    with_false += s.has_false_lines() ? 1 : 0;
  }
};

fs::path labelled_pictures() { return fs::path(LIGHTSTRIPE_SOURCE_DIR) / "../shared/data/real_stripes"; }

TEST(RealStripes, AreCompleteAndWithoutFalseLinesByDefault) {
  if (!fs::exists(labelled_pictures())) GTEST_SKIP() << "no ../shared/data/real_stripes";
  Score score;
  for (const LabelledPicture& picture : read_labelled_pictures(labelled_pictures()))
    score.add(picture, read_image(picture.file));
  EXPECT_EQ(score.lit, 65);
  EXPECT_GE(score.complete, 60);
  EXPECT_EQ(score.missed, 0);
  EXPECT_LE(score.with_false, 2);
}

Score of_other_camera(std::string_view name) {
  Score score;
  for (const LabelledPicture& picture : read_labelled_pictures(labelled_pictures()))
    score.add(picture, imitated(other_camera(name), read_rgb_image(picture.file)));
  EXPECT_EQ(score.lit, 65);
  return score;
}

// Another camera ends its range at 235, as many do: 26 complete and 30 with false lines when 250 was clipped.
TEST(RealStripes, InVideoRangeAreTheSame) {
  if (!fs::exists(labelled_pictures())) GTEST_SKIP() << "no ../shared/data/real_stripes";
  const Score score = of_other_camera("video range 16 to 235");
  EXPECT_GE(score.complete, 58);
  EXPECT_EQ(score.missed, 0);
  EXPECT_LE(score.with_false, 3);
}

// Edges of lit things made 8 lines invisible, some of which are 100 grey levels brighter than any of them.
TEST(RealStripes, InGreyAreHardlyEverMissed) {
  if (!fs::exists(labelled_pictures())) GTEST_SKIP() << "no ../shared/data/real_stripes";
  const Score score = of_other_camera("grey");
  EXPECT_GE(score.complete, 46);
  EXPECT_LE(score.missed, 1);
  EXPECT_LE(score.with_false, 15);
}

// A codec keeps a grey level or two of a thin line's colour: 46 complete and 3 missed when that was too
// little.
TEST(RealStripes, OfACodecThatKeepsLittleColourAreFound) {
  if (!fs::exists(labelled_pictures())) GTEST_SKIP() << "no ../shared/data/real_stripes";
  const Score score = of_other_camera("JPEG of quality 30");
  EXPECT_GE(score.complete, 49);
  EXPECT_LE(score.missed, 1);
  EXPECT_LE(score.with_false, 6);
}

}  // namespace
}  // namespace lightstripe
