// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What the paper calls selective processing: thresholds by rule, a region of interest, a start hint, an early
// stop.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "extraction/extract_stripes.h"
#include "stripe_scenes.h"

namespace lightstripe {
namespace {

/// Three horizontal lines, the middle one the brightest.
Image8 three_lines() {
  scenes::Canvas canvas(300, 240, 6);
  canvas.add(scenes::make_line(-10, 50.3, 310, 50.3, 90, 2));
  canvas.add(scenes::make_line(-10, 120.6, 310, 120.6, 180, 2));
  canvas.add(scenes::make_line(-10, 190.4, 310, 190.4, 120, 2));
  return canvas.exposed(1.5, 0.03, 6);
}

ExtractionOptions with_sigma() {
  ExtractionOptions options;
  options.sigma = 2.0;
  return options;
}

double mean_y(const Stripe& stripe) {
  double sum = 0;
  for (const StripePoint& p : stripe.points) sum += p.y;
  return sum / static_cast<double>(stripe.points.size());
}

TEST(Thresholds, OtsuAndRosinAreTheImagesOwn) {
  const Image8 image = three_lines();
  ExtractionOptions options = with_sigma();
  for (const char* rule : {"otsu", "rosin"}) {
    options.thresholds = rule;
    const auto r = extract_stripes(image.view(), options);
    const double expected = rule[0] == 'o' ? r.levels.t_otsu : r.levels.t_rosin;
    EXPECT_EQ(r.threshold_low, expected);
    EXPECT_EQ(r.threshold_high, expected);
    EXPECT_EQ(r.stripes.size(), 3U) << rule;
  }
  options.thresholds = "bilevel";
  const auto bilevel = extract_stripes(image.view(), options);
  options.thresholds = "auto";
  EXPECT_EQ(bilevel.threshold_low, extract_stripes(image.view(), options).threshold_low);
}

TEST(Thresholds, GivenOnesKeepDarkLinesOutOfEveryMethod) {
  const Image8 image = three_lines();
  ExtractionOptions options = with_sigma();
  options.thresholds = "110,115";
  for (const auto& [method, name] : enum_names(ExtractionMethod{})) {
    options.method = method;
    const auto r = extract_stripes(image.view(), options);
    EXPECT_EQ(r.stripes.size(), 2U) << name;
    EXPECT_EQ(r.threshold_low, 110);
  }
}

TEST(RegionOfInterest, GivesPointsOfTheWholeImagesCoordinates) {
  const Image8 image = three_lines();
  ExtractionOptions options = with_sigma();
  options.roi = "100,80,150,80";
  const auto r = extract_stripes(image.view(), options);
  ASSERT_EQ(r.stripes.size(), 1U);
  EXPECT_NEAR(mean_y(r.stripes[0]), 120.6, 0.02);
  EXPECT_GE(r.stripes[0].points.front().x, 99.5);
  EXPECT_LE(r.stripes[0].points.back().x, 249.5);
  EXPECT_GE(r.stripes[0].points.size(), 148U);
  options.roi = "400,400,10,10";  // beside the image
  EXPECT_TRUE(extract_stripes(image.view(), options).stripes.empty());
}

TEST(StartHint, TheLineNearestToItIsTheOneThatIsFollowed) {
  const Image8 image = three_lines();
  ExtractionOptions options = with_sigma();
  options.stop_after = 1;
  EXPECT_NEAR(mean_y(extract_stripes(image.view(), options).stripes.at(0)), 120.6, 0.05);
  options.start = "150,194";
  const auto r = extract_stripes(image.view(), options);
  ASSERT_EQ(r.stripes.size(), 1U);
  EXPECT_NEAR(mean_y(r.stripes[0]), 190.4, 0.05);
}

TEST(StopAfter, LimitsTheLinesThatAreFollowed) {
  const Image8 image = three_lines();
  ExtractionOptions options = with_sigma();
  for (const int lines : {1, 2}) {
    options.stop_after = lines;
    EXPECT_EQ(extract_stripes(image.view(), options).stripes.size(), static_cast<std::size_t>(lines));
  }
}

TEST(SelectiveOptions, BadTextsAreErrorsThatNameTheOption) {
  const Image8 image(20, 20, 0);
  const auto message = [&](auto change) -> std::string {
    ExtractionOptions options;
    change(options);
    try {
      extract_stripes(image.view(), options);
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  };
  for (const char* bad : {"1,2,3", "1,2,3,0", "-1,2,3,4", "a", "1,2,3,4,5", "1 ,2,3,4", "nan,1,2,3"})
    EXPECT_EQ(message([&](ExtractionOptions& o) { o.roi = bad; }).rfind("roi", 0), 0U) << bad;
  for (const char* bad : {"1", "1,", "x,y", "1,2,3"})
    EXPECT_EQ(message([&](ExtractionOptions& o) { o.start = bad; }).rfind("start", 0), 0U) << bad;
  EXPECT_EQ(message([](ExtractionOptions& o) { o.stop_after = -1; }).rfind("stop_after", 0), 0U);
  EXPECT_EQ(message([](ExtractionOptions& o) { o.thresholds = "Otsu"; }).rfind("thresholds", 0), 0U);
}

}  // namespace
}  // namespace lightstripe
