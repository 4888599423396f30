// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Real, labelled pictures beside the project's folder, default options: how many are complete, and how many
// have false lines, by the rules of score.py beside them. Left out where they are not there.
#include <gtest/gtest.h>

#include <filesystem>

#include "extraction/extract_stripes.h"
#include "io/images.h"
#include "report/line_labels.h"
#include "test_paths.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

TEST(RealStripes, AreCompleteAndWithoutFalseLinesByDefault) {
  const fs::path root = fs::path(LIGHTSTRIPE_SOURCE_DIR) / "../shared/data/real_stripes";
  if (!fs::exists(root)) GTEST_SKIP() << "no ../shared/data/real_stripes";
  int lit = 0, complete = 0, missed = 0, with_false = 0;
  for (const LabelledPicture& picture : read_labelled_pictures(root)) {
    const LabelScore s = score_lines(picture.lines, extract_stripes(read_image(picture.file).view()).stripes);
    lit += s.has_laser() ? 1 : 0;
    complete += s.has_laser() && s.complete() ? 1 : 0;
    missed += s.has_laser() && s.cover() < 0.05 ? 1 : 0;
    with_false += s.has_false_lines() ? 1 : 0;
  }
  EXPECT_EQ(lit, 65);
  EXPECT_GE(complete, 60);
  EXPECT_EQ(missed, 0);
  EXPECT_LE(with_false, 2);
}

}  // namespace
}  // namespace lightstripe
