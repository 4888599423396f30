// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Real, labelled pictures beside the project's folder, default options: how many are complete, and how many
// have false lines, by the rules of score.py beside them. Left out where they are not there.
#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "extraction/extract_stripes.h"
#include "io/images.h"
#include "report/line_labels.h"
#include "test_paths.h"
#include "tests/io/temp_folder.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

struct Score {
  int lit = 0, complete = 0, missed = 0, with_false = 0;

  void add(const LabelledPicture& picture, const fs::path& file) {
    const LabelScore s = score_lines(picture.lines, extract_stripes(read_image(file).view()).stripes);
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
    score.add(picture, picture.file);
  EXPECT_EQ(score.lit, 65);
  EXPECT_GE(score.complete, 60);
  EXPECT_EQ(score.missed, 0);
  EXPECT_LE(score.with_false, 2);
}

// Another camera ends its range at 235, as many do: 26 complete and 30 with false lines when 250 was clipped.
TEST(RealStripes, InVideoRangeAreTheSame) {
  if (!fs::exists(labelled_pictures())) GTEST_SKIP() << "no ../shared/data/real_stripes";
  const TempFolder folder;
  Score score;
  for (const LabelledPicture& picture : read_labelled_pictures(labelled_pictures())) {
    cv::Mat pixels = cv::imread(picture.file.string(), cv::IMREAD_COLOR);
    pixels.convertTo(pixels, CV_8U, 219.0 / 255, 16);
    cv::imwrite((folder / "video.bmp").string(), pixels);
    score.add(picture, folder / "video.bmp");
  }
  EXPECT_EQ(score.lit, 65);
  EXPECT_GE(score.complete, 58);
  EXPECT_EQ(score.missed, 0);
  EXPECT_LE(score.with_false, 3);
}

}  // namespace
}  // namespace lightstripe
