// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "core/polyline_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/random.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

// The obvious way: look at every segment.
double distance_by_looking_everywhere(const std::vector<Vector2d>& line, const Vector2d& q) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vector2d d = line[i + 1] - line[i];
    const double t = std::fmin(1.0, std::fmax(0.0, (q - line[i]).dot(d) / d.squaredNorm()));
    best = std::fmin(best, (q - line[i] - t * d).norm());
  }
  return best;
}

TEST(PolylineSearch, FindsTheFootOnASegment) {
  const PolylineSearch search(std::vector<Vector2d>{{0, 0}, {10, 0}, {10, 10}}, 5);
  const auto foot = search.nearest({4, -2});
  ASSERT_TRUE(foot);
  EXPECT_EQ(foot->position, Vector2d(4, 0));
  EXPECT_EQ(foot->segment, 0);
  EXPECT_EQ(foot->normal, Vector2d(0, -1));
  EXPECT_EQ(foot->signed_distance, 2);
  EXPECT_FALSE(foot->beyond_end);
}

TEST(PolylineSearch, NormalPointsFromACornerToTheQuery) {
  const auto foot = PolylineSearch(std::vector<Vector2d>{{0, 0}, {10, 0}, {10, 10}}, 5).nearest({13, -4});
  ASSERT_TRUE(foot);
  EXPECT_EQ(foot->position, Vector2d(10, 0));
  EXPECT_LT((foot->normal - Vector2d(0.6, -0.8)).norm(), 1e-15);
  EXPECT_NEAR(foot->signed_distance, 5, 1e-14);
  EXPECT_FALSE(foot->beyond_end);
}

TEST(PolylineSearch, TellsWhatLiesPastAnOpenEnd) {
  const std::vector<Vector2d> open{{0, 0}, {10, 0}, {10, 10}}, closed{{0, 0}, {10, 0}, {10, 10}, {0, 0}};
  EXPECT_TRUE(PolylineSearch(open, 5).nearest({-1, -1})->beyond_end);
  EXPECT_TRUE(PolylineSearch(open, 5).nearest({11, 12})->beyond_end);
  EXPECT_FALSE(PolylineSearch(open, 5).nearest({0, 1})->beyond_end);  // square to the end
  EXPECT_FALSE(PolylineSearch(closed, 5).nearest({-1, -1})->beyond_end);
}

TEST(PolylineSearch, AgreesWithLookingEverywhere) {
  Random random(3);
  std::vector<Vector2d> line;
  for (int i = 0; i < 300; ++i) line.emplace_back(0.3 * i, 8 * std::sin(0.11 * i) + random.uniform(-1, 1));
  const PolylineSearch search(line, 6);
  int found = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vector2d q(random.uniform(-10, 100), random.uniform(-20, 20));
    const double expected = distance_by_looking_everywhere(line, q);
    const auto foot = search.nearest(q);
    ASSERT_EQ(foot.has_value(), expected <= 6) << q.transpose();
    if (!foot) continue;
    ++found;
    EXPECT_NEAR(std::abs(foot->signed_distance), expected, 1e-12) << q.transpose();
    EXPECT_NEAR((q - foot->position).norm(), expected, 1e-12);
  }
  EXPECT_GT(found, 1000);
}

TEST(PolylineSearch, FarAndInvalidQueriesFindNothing) {
  const PolylineSearch search(std::vector<Vector2d>{{0, 0}, {10, 0}}, 5);
  EXPECT_FALSE(search.nearest({5, 5.001}));
  EXPECT_FALSE(search.nearest({1e300, 0}));
  EXPECT_FALSE(search.nearest({std::nan(""), 0}));
}

TEST(PolylineSearch, RefusesWhatIsNoPolyline) {
  EXPECT_THROW(PolylineSearch(std::vector<Vector2d>{{0, 0}}, 5), std::logic_error);
  EXPECT_THROW(PolylineSearch(std::vector<Vector2d>{{1, 2}, {1, 2}}, 5), std::logic_error);
  EXPECT_THROW(PolylineSearch(std::vector<Vector2d>{{0, 0}, {1, std::nan("")}}, 5), std::logic_error);
}

}  // namespace
}  // namespace lightstripe
