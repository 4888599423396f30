// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/real_pictures_page.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <regex>

#include "io/atomic_file.h"
#include "io/images.h"
#include "test_paths.h"
#include "tests/io/temp_folder.h"

namespace lightstripe {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

LabelledLine label(double x, double from, double to, bool laser = true) {
  LabelledLine line;
  for (double y = from; y <= to; y += 1) line.places.emplace_back(x, y);
  line.half_width = 3;
  line.laser = laser;
  return line;
}

Stripe stripe(double x, int from, int to) {
  Stripe out;
  for (int y = from; y <= to; ++y) out.points.push_back({x, 1.0 * y, 1, 0, 6, 10, 0.05, 80, 0});
  return out;
}

TEST(LineLabels, ScoreByTheRulesOfThePage) {
  const std::vector<LabelledLine> labels = {label(50, 10, 109), label(80, 10, 59, false)};
  LabelScore whole = score_lines(labels, {stripe(50.5, 10, 109)});
  EXPECT_TRUE(whole.complete());
  EXPECT_FALSE(whole.has_false_lines());
  EXPECT_NEAR(std::sqrt(whole.squares / static_cast<double>(whole.near_points)), 0.5, 1e-9);
  // A mirror image that is marked as such counts neither way; one that is not is false.
  EXPECT_FALSE(score_lines(labels, {stripe(50, 10, 109), stripe(80, 10, 59)}).has_false_lines());
  EXPECT_TRUE(score_lines(labels, {stripe(50, 10, 109), stripe(65, 10, 59)}).has_false_lines());
  const LabelScore part = score_lines(labels, {stripe(50, 10, 99)});
  EXPECT_NEAR(part.cover(), 0.92, 1e-9);  // the tolerance reaches 2 px on
  EXPECT_FALSE(part.complete());
}

TEST(LineLabels, TellWhatAMissedStretchLooksLike) {
  Image8 image(120, 120, 20);
  for (int y = 10; y < 110; ++y)
    for (int x = 48; x <= 52; ++x) image(x, y) = y < 60 ? 200 : 26;
  const std::vector<LabelledLine> labels = {label(50, 10, 109)};
  const std::vector<Stripe> stripes = {stripe(50, 10, 60), stripe(90, 10, 40)};
  LabelScore score = score_lines(labels, stripes);
  explain_score(labels, stripes, image.view(), 1.0, score);
  ASSERT_THAT(score.missed, SizeIs(1));
  EXPECT_THAT(score.missed[0].text, HasSubstr("missed 47 px at (50, 86): faint: 6 grey levels, 3 %"));
  ASSERT_THAT(score.false_lines, SizeIs(1));
  EXPECT_THAT(score.false_lines[0].text, HasSubstr("31 false points at (90, 25)"));
}

TEST(LineLabels, AreReadFromTheirFolder) {
  const TempFolder folder;
  folder.write(
      "set/a.json",
      R"({"image": "a.png", "note": "", "lines": [{"points": [[1, 2], [1, 12.5]], "half_width": 4.5, "kind": "laser"}]})");
  const auto pictures = read_labelled_pictures(folder.path());
  ASSERT_THAT(pictures, SizeIs(1));
  EXPECT_EQ(pictures[0].set, "set");
  EXPECT_EQ(pictures[0].file, folder.path() / "set/a.png");
  ASSERT_THAT(pictures[0].lines[0].places, SizeIs(12));
  EXPECT_EQ(pictures[0].lines[0].half_width, 4.5);
  folder.write("set/b.json", "{}");
  EXPECT_THROW(read_labelled_pictures(folder.path()), Error);
  EXPECT_THROW(read_labelled_pictures(folder.path() / "none"), Error);
}

/// The page with every number, name and reason taken out.
std::vector<std::string> form_of(const std::string& page) {
  std::vector<std::string> form;
  for (std::size_t begin = 0; begin < page.size();) {
    const std::size_t end = std::min(page.find('\n', begin), page.size());
    std::string line = page.substr(begin, end - begin);
    begin = end + 1;
    const bool table = line.starts_with("|");
    if (table && !line.starts_with("|--") && !line.starts_with("| set | method") &&
        !line.starts_with("| contrast ") && !line.starts_with("| camera ") && !line.starts_with("| picture "))
      line = "row of " + std::to_string(std::count(line.begin(), line.end(), '|'));
    if (form.empty() || form.back() != line) form.push_back(line);
  }
  return form;
}

TEST(RealPicturesPage, InTheDocsIsOfTheFormThatTheCommandMakes) {
  const auto docs = std::filesystem::path(LIGHTSTRIPE_SOURCE_DIR) / "docs/real_pictures.md";
  MethodScore hard{"direction-guided", "set", "a.png", {}, 0.5, 10};
  hard.score.laser_px = 100;
  hard.score.covered_px = 50;
  hard.score.missed = {{50, "missed 50 px at (1, 2): faint: 6 grey levels, 6 % of the strongest stretch"}};
  MethodScore grey = hard;
  grey.method = "grey";
  const std::string page = real_pictures_page({hard}, {grey}, {{0.3, 1.6, 4, 1, 0, 0.2, 0.1, 1.1, 1.0}});
  EXPECT_THAT(page, HasSubstr("| set | direction-guided | 0 of 1 | 0 | 50.0 % | 0 of 1 |  | 0.50 | 20.0 |"));
  EXPECT_THAT(page, HasSubstr("| grey | 0 of 1 | 0 | 50.0 % | 0 of 1 |"));
  EXPECT_THAT(page, HasSubstr("| set/a.png | 50.0 % | 0 | missed 50 px at (1, 2): faint"));
  EXPECT_EQ(form_of(read_file(docs)), form_of(page));
}

}  // namespace
}  // namespace lightstripe
