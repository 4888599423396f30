// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The paper's scenes, a rail with reflections and a checkerboard, with noise and default options.
#include <gtest/gtest.h>

#include "extraction/draw/overlay.h"
#include "extraction/extract_stripes.h"
#include "whole_scenes.h"

namespace lightstripe {
namespace {

using namespace scenes;  // NOLINT(google-build-using-namespace): a test of exactly these

TEST(WholeScenes, PapersFourKindsAreCompleteWithoutFalseLines) {
  const std::size_t lines[] = {2, 2, 3, 5};
  for (int kind = 0; kind < 4; ++kind) {
    const Scene scene = paper_scene(kind);
    const auto r = extract_stripes(scene.canvas.exposed(2, 0.05, 7).view());
    const Score s = score(scene.truth, r.stripes);
    EXPECT_EQ(r.stripes.size(), lines[kind]) << "kind " << kind;
    EXPECT_GE(s.completeness, 0.99) << "kind " << kind;
    EXPECT_EQ(s.false_points, 0) << "kind " << kind;
    EXPECT_LE(s.rms_px, 0.03) << "kind " << kind;
  }
}

TEST(WholeScenes, RailsWithReflectionsAreCompleteToNinetySevenPercent) {
  double completeness = 0;
  int points = 0, false_points = 0;
  constexpr int kScenes = 9;
  for (int k = 0; k < kScenes; ++k) {
    const Scene scene = rail_scene(static_cast<std::uint64_t>(k), (k % 3) * 6);
    const auto r =
        extract_stripes(scene.canvas.exposed(1.5, 0.08, 100 + static_cast<std::uint64_t>(k)).view());
    const Score s = score(scene.truth, r.stripes);
    completeness += s.completeness / kScenes;
    points += s.points;
    false_points += s.false_points;
  }
  EXPECT_GE(completeness, 0.98);
  EXPECT_LE(false_points, points / 1000);
}

TEST(WholeScenes, LineOverACheckerboardIsFollowedThroughBlackSquares) {
  for (const double angle : {0.3, 1.5, 2.3})
    for (const double black : {0.05, 0.2}) {
      const Scene scene = checkerboard_scene(angle, black, 0);
      const auto r = extract_stripes(scene.canvas.exposed(1.5, 0.05, 9).view());
      const Score s = score(scene.truth, r.stripes, 2.0, 3.0);
      EXPECT_GE(s.completeness, black < 0.1 ? 0.9 : 0.97) << angle << ' ' << black;
      EXPECT_LE(s.false_points, s.points / 50) << angle << ' ' << black;
    }
}

TEST(WholeScenes, NothingIsFoundInNoiseAndSpots) {
  for (const double noise : {0.0, 1.5, 6.0})
    for (const double level : {3.0, 120.0}) {
      const Canvas canvas(960, 700, level);
      EXPECT_TRUE(extract_stripes(canvas.exposed(noise, 0, 5).view()).stripes.empty())
          << noise << ' ' << level;
    }
  Canvas spots(960, 700, 5);
  Random random(2);
  for (int k = 0; k < 12; ++k)
    spots.add_blob(random.uniform(30, 930), random.uniform(30, 670), random.uniform(2.5, 20),
                   random.uniform(2.5, 20), 0, 500);
  EXPECT_TRUE(extract_stripes(spots.exposed(1.5, 0.05, 5).view()).stripes.empty());
}

TEST(WholeScenes, StegerFindsTheSameLines) {
  const Scene scene = paper_scene(2);
  ExtractionOptions options;
  options.sigma = 3;
  const Image8 image = scene.canvas.exposed(2, 0.05, 7);
  const auto guided = extract_stripes(image.view(), options);
  options.method = ExtractionMethod::kSteger;
  const auto whole = extract_stripes(image.view(), options);
  ASSERT_EQ(guided.stripes.size(), whole.stripes.size());
  const Score a = score(scene.truth, guided.stripes), b = score(scene.truth, whole.stripes);
  EXPECT_LE(a.rms_px, 1.05 * b.rms_px);
  EXPECT_GE(a.completeness, b.completeness - 0.001);
}

TEST(Overlay, DrawsTheLineAtItsPlace) {
  Image8 image(40, 30, 100);
  Stripe stripe;
  for (int x = 5; x < 35; ++x) {
    StripePoint p;
    p.x = x;
    p.y = 12;
    stripe.points.push_back(p);
  }
  const auto rgb = draw_overlay(image.view(), {stripe}, {3, 0.5});
  ASSERT_EQ(rgb.size(), 40U * 30U * 9U * 3U);
  const auto at = [&](int x, int y) { return &rgb[static_cast<std::size_t>((y * 120 + x) * 3)]; };
  // The centre of pixel (20, 12) lies at (61, 37) of the picture; grey elsewhere.
  EXPECT_GT(at(61, 37)[0], 150);
  EXPECT_EQ(at(61, 70)[0], 50);
  EXPECT_EQ(at(61, 70)[2], 50);
}

}  // namespace
}  // namespace lightstripe
