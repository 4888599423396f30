// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The lines of one picture judged against each other: faint ones are dropped, unless they go on where a
// strong one ends.
#include "extraction/lines/faint_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "extraction/extract_stripes.h"

namespace lightstripe {
namespace {

/// A piece of a vertical line.
struct Piece {
  double x, first, last, peak;  ///< px, rows, grey levels
};

Image8 picture_of(const std::vector<Piece>& pieces) {
  Random random(5, 7);
  Image8 image(320, 400);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      double level = 12 + 0.7 * random.gaussian();
      for (const Piece& p : pieces)
        if (y >= p.first && y <= p.last) level += p.peak * std::exp(-0.5 * std::pow((x - p.x) / 2, 2));
      image(x, y) = static_cast<std::uint8_t>(std::clamp(std::lround(level), 0L, 255L));
    }
  return image;
}

/// Rows with a point within 2 px of `x`, from `first` to `last`.
int rows_found(const ExtractionResult& result, double x, double first, double last) {
  int rows = 0;
  for (const Stripe& stripe : result.stripes)
    for (const StripePoint& p : stripe.points)
      rows += std::abs(p.x - x) < 2 && p.y >= first && p.y <= last ? 1 : 0;
  return rows;
}

TEST(FaintLines, ADimPieceStaysWhereTheLineGoesOnAndNowhereElse) {
  const Piece strong{100.3, 0, 200, 150}, dim{100.3, 215, 285, 14}, elsewhere{220.3, 215, 285, 14};
  const auto result = extract_stripes(picture_of({strong, dim, elsewhere}).view());
  EXPECT_GT(rows_found(result, strong.x, 0, 200), 195);
  EXPECT_GT(rows_found(result, dim.x, 215, 285), 60);
  EXPECT_EQ(rows_found(result, elsewhere.x, 0, 400), 0);
}

TEST(FaintLines, AsLongAsTheStrongOneAFaintLineNeedsNoOther) {
  const auto result = extract_stripes(picture_of({{100.3, 0, 399, 150}, {220.3, 0, 399, 18}}).view());
  EXPECT_GT(rows_found(result, 220.3, 0, 399), 390);
}

/// Edges of 110 grey levels, whose brighter sides are at 130.
constexpr EdgeCrowd kManyEdges{2000, 2000 * 110, 2000 * 130};

/// How many lines of these facts stay in a grey picture with these edges; they lie far from each other.
/// `extent`: as in FaintLineRule.
std::size_t how_many_stay(std::vector<LineFacts> all, const EdgeCrowd& edges, double extent = 0) {
  const DerivativeKernels kernels = make_derivative_kernels(2);
  LineSet lines;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const std::size_t begin = lines.points.size();
    lines.points.resize(begin + static_cast<std::size_t>(all[k].length));
    for (std::size_t i = begin; i < lines.points.size(); ++i) {
      lines.points[i].x = 500.0 * static_cast<double>(k);
      lines.points[i].y = static_cast<double>(i - begin);
    }
    lines.lines.push_back({begin, lines.points.size()});
    all[k].mean_strength = all[k].intensity * kernels.matched_strength();
  }
  const FilteredLines group{&kernels, &lines, &all};
  drop_faint_lines({&group, 1}, {}, {1, 2, 20, 220, extent}, edges);
  return lines.lines.size();
}

/// Whether one line of these facts stays.
bool stays(const LineFacts& facts, const EdgeCrowd& edges) { return how_many_stay({facts}, edges) == 1; }

TEST(FaintLines, AmongEdgesALineIsHigherOrBrighterThanTheyAreOrLongAndEven) {
  const LineFacts line{.length = 60, .width = 7, .intensity = 115, .level = 140, .flanks = 0.9, .colour = {}};
  EXPECT_FALSE(stays(line, kManyEdges));
  LineFacts high = line, on_paper = line, lengthy = line, uneven = line;
  high.intensity = 140;
  on_paper.level = 240;
  lengthy.length = uneven.length = 200;
  uneven.odd_share = 0.6;
  EXPECT_TRUE(stays(high, kManyEdges));
  EXPECT_TRUE(stays(on_paper, kManyEdges));
  EXPECT_TRUE(stays(lengthy, kManyEdges));
  EXPECT_FALSE(stays(uneven, kManyEdges));
}

TEST(FaintLines, ABarWithAFlatTopBelowTheEndOfTheRangeIsNoLight) {
  LineFacts bar{.length = 200, .width = 7, .intensity = 140, .level = 160, .flatness = 0.95, .colour = {}};
  EXPECT_FALSE(stays(bar, kManyEdges));
  EXPECT_TRUE(stays(bar, {}));  // it may be drawn
  constexpr EdgeCrowd kSomeEdges{30, 30 * 110, 30 * 130};
  EXPECT_FALSE(stays(bar, kSomeEdges));
  LineFacts round = bar;
  round.flatness = 0.87;  // a lens' disc of blur
  EXPECT_TRUE(stays(round, kSomeEdges));
  bar.width = 14;
  EXPECT_FALSE(stays(bar, {}));
  bar.clipped_share = 1;
  EXPECT_TRUE(stays(bar, kManyEdges));
}

TEST(FaintLines, BroaderAndUnevenIsAThingInOtherLight) {
  const LineFacts line{
      .length = 300, .width = 6, .intensity = 60, .level = 100, .flanks = 0.95, .colour = {}};
  LineFacts shading = line;
  shading.width = 25;
  shading.flanks = 0.6;
  EXPECT_EQ(how_many_stay({line, shading}, {}), 1U);
  // The only thing in its picture; not where somebody says that there is a line.
  constexpr double kExtent = 1100;
  EXPECT_EQ(how_many_stay({shading}, {}, kExtent), 0U);
  EXPECT_TRUE(stays(shading, {}));
  LineFacts uneven_in_places = shading, narrow = shading;
  uneven_in_places.flanks = narrow.flanks = 0.95;
  uneven_in_places.odd_share = narrow.odd_share = 0.4;
  narrow.width = 8;
  EXPECT_EQ(how_many_stay({uneven_in_places}, {}, kExtent), 0U);
  EXPECT_EQ(how_many_stay({narrow}, {}, kExtent), 1U);
  // Not a line out of focus, a glowing one as wide as the others, bloom, or what has the laser's colour.
  LineFacts out_of_focus = shading, glowing = shading, bloom = shading, coloured = shading;
  out_of_focus.flanks = 0.9;
  glowing.width = 7;
  bloom.clipped_share = 0.8;
  coloured.colour_known = true;
  for (const LineFacts& light : {out_of_focus, glowing, bloom, coloured})
    EXPECT_EQ(how_many_stay({line, light}, {}), 2U);
}

TEST(FaintLines, TheLongestCrumbsOfATextureAreNoLaser) {
  constexpr double kExtent = 1100;
  const LineFacts crumb{.length = 60,
                        .width = 7,
                        .intensity = 60,
                        .level = 120,
                        .odd_share = 0.3,
                        .flanks = 0.75,
                        .colour = {}};
  LineFacts faint = crumb;
  faint.intensity = 3;  // dropped
  std::vector<LineFacts> crumbs(6, crumb);
  EXPECT_EQ(how_many_stay(crumbs, {}, kExtent), 6U);  // nothing else is there
  crumbs.push_back(faint);
  EXPECT_EQ(how_many_stay(crumbs, {}, kExtent), 0U);
  crumbs[2].length = 80;  // 6 widths even
  EXPECT_EQ(how_many_stay(crumbs, {}, kExtent), 6U);
  crumbs[2] = crumb;
  EXPECT_EQ(how_many_stay(crumbs, {}, 0), 6U);  // somebody says that there is a line
}

TEST(FaintLines, TheStrongestOfAPicturesThingsIsNoLaser) {
  constexpr double kExtent = 1100;
  // 60 px of 40 grey levels, in a picture with 100 px of edges twice as high.
  const LineFacts thing{.length = 60, .width = 6, .intensity = 40, .level = 200, .flanks = 0.9, .colour = {}};
  const EdgeCrowd edges{100, 100 * 80, 100 * 120};
  EXPECT_EQ(how_many_stay({thing}, edges, kExtent), 0U);
  LineFacts bar = thing;
  bar.length = 200;
  bar.flatness = 0.95;
  bar.width = 14;
  EXPECT_EQ(how_many_stay({thing, bar}, {}, kExtent), 0U);  // what was dropped speaks for things
  EXPECT_EQ(how_many_stay({thing}, {}, kExtent), 1U);       // nothing else is there: a wire in the dark
  EXPECT_EQ(how_many_stay({thing}, edges, 0), 1U);          // somebody says that there is a line
  LineFacts line = thing, clipped = thing;
  line.length = 300;
  clipped.clipped_share = 0.5;
  EXPECT_EQ(how_many_stay({line}, edges, kExtent), 1U);
  EXPECT_EQ(how_many_stay({clipped}, edges, kExtent), 1U);
}

}  // namespace
}  // namespace lightstripe
