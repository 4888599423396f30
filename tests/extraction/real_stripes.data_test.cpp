// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Real, labelled pictures beside the project's folder, default options: how many are complete, and how many
// have false lines, by the rules of score.py beside them. Left out where they are not there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <regex>
#include <sstream>

#include "extraction/extract_stripes.h"
#include "io/images.h"
#include "test_paths.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

struct Place {
  double x, y;
};
struct LabelledLine {
  std::vector<Place> places;  ///< one a px
  double half_width = 3;
  bool laser = false;
};

std::vector<LabelledLine> read_labels(const fs::path& file) {
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  const std::string all = text.str();
  const std::regex line(R"re("points": \[(.*?\])\], "half_width": ([0-9.]+), "kind": "(\w+)")re");
  const std::regex pair(R"re(\[(-?[0-9.]+), (-?[0-9.]+)\])re");
  std::vector<LabelledLine> lines;
  for (std::sregex_iterator it(all.begin(), all.end(), line), end; it != end; ++it) {
    LabelledLine& label = lines.emplace_back();
    label.half_width = std::stod((*it)[2]);
    label.laser = (*it)[3] == "laser";
    const std::string points = (*it)[1];
    for (std::sregex_iterator p(points.begin(), points.end(), pair); p != end; ++p) {
      const Place next{std::stod((*p)[1]), std::stod((*p)[2])};
      if (!label.places.empty()) {
        const Place last = label.places.back();
        const int steps =
            std::max(1, static_cast<int>(std::ceil(std::hypot(next.x - last.x, next.y - last.y))));
        for (int k = 1; k < steps; ++k)
          label.places.push_back(
              {last.x + (next.x - last.x) * k / steps, last.y + (next.y - last.y) * k / steps});
      }
      label.places.push_back(next);
    }
  }
  return lines;
}

double distance(const Place& p, const std::vector<Place>& to) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Place& q : to)
    nearest = std::min(nearest, (p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y));
  return std::sqrt(nearest);
}

struct Score {
  double laser = 0, covered = 0;  ///< px
  int points = 0, false_points = 0;
  bool complete() const { return covered >= 0.95 * laser; }
  bool has_false_lines() const { return false_points > 8 && false_points > 0.02 * points; }
};

Score score(const std::vector<LabelledLine>& labels, const std::vector<Stripe>& stripes) {
  std::vector<Place> found;
  for (const Stripe& stripe : stripes)
    for (const StripePoint& p : stripe.points) found.push_back({p.x, p.y});
  Score s;
  s.points = static_cast<int>(found.size());
  for (const LabelledLine& label : labels) {
    if (!label.laser || label.places.size() < 2) continue;
    s.laser += static_cast<double>(label.places.size());
    for (const Place& p : label.places)
      s.covered += distance(p, found) <= std::max(2.0, 0.7 * label.half_width) ? 1 : 0;
  }
  for (const Place& p : found) {
    const bool near = std::any_of(labels.begin(), labels.end(), [&](const LabelledLine& label) {
      return distance(p, label.places) <= std::max(3.0, 1.5 * label.half_width);
    });
    s.false_points += near ? 0 : 1;
  }
  return s;
}

TEST(RealStripes, AreCompleteAndWithoutFalseLinesByDefault) {
  const fs::path root = fs::path(LIGHTSTRIPE_SOURCE_DIR) / "../shared/data/real_stripes";
  if (!fs::exists(root)) GTEST_SKIP() << "no ../shared/data/real_stripes";
  int lit = 0, complete = 0, missed = 0, with_false = 0;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (entry.path().extension() != ".json") continue;
    fs::path picture = entry.path();
    for (const char* extension : {".png", ".jpg"})
      if (fs::exists(fs::path(entry.path()).replace_extension(extension)))
        picture.replace_extension(extension);
    const auto labels = read_labels(entry.path());
    const Score s = score(labels, extract_stripes(read_image(picture).view()).stripes);
    lit += s.laser > 0 ? 1 : 0;
    complete += s.laser > 0 && s.complete() ? 1 : 0;
    missed += s.laser > 0 && s.covered < 0.05 * s.laser ? 1 : 0;
    with_false += s.has_false_lines() ? 1 : 0;
  }
  EXPECT_EQ(lit, 65);
  EXPECT_GE(complete, 60);
  EXPECT_EQ(missed, 0);
  EXPECT_LE(with_false, 2);
}

}  // namespace
}  // namespace lightstripe
