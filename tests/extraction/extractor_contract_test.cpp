// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What every method promises: the centre moves with the stripe and with nothing else.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "extraction/extract_stripes.h"
#include "stripe_scenes.h"

namespace lightstripe {
namespace {

using scenes::Canvas;
using scenes::Curve;
using scenes::CurvePoint;
using scenes::make_curve;

class ExtractorContract : public testing::TestWithParam<ExtractionMethod> {
 protected:
  ExtractionOptions options() const {
    ExtractionOptions o;
    o.method = GetParam();
    o.sigma = 2.0;
    return o;
  }
  std::vector<Stripe> extract(const Image8& image) const {
    return extract_stripes(image.view(), options()).stripes;
  }
  /// A nearly vertical stripe; centroids of slanted runs are biased by nature.
  static Curve stripe(double x, double peak = 150, double slope = 0.0) {
    return scenes::make_line(x, -20, x + slope, 220, peak, 2.0);
  }
  static Image8 render(const std::vector<Curve>& curves, double background = 4, double scale = 1) {
    Canvas canvas(240, 200, background);
    for (const Curve& c : curves) canvas.add(c);
    for (double& g : canvas.grey.pixels) g *= scale;
    return canvas.exposed(0, 0, 1);
  }
  /// Mean x of the points of the longest stripe, away from the image's border.
  static double mean_x(const std::vector<Stripe>& stripes) {
    double sum = 0;
    int count = 0;
    for (const StripePoint& p : stripes.at(0).points)
      if (p.y > 20.5 && p.y < 179.5) {  // between rows, so that no rounding decides which points count
        sum += p.x;
        ++count;
      }
    return sum / count;
  }
};

TEST_P(ExtractorContract, OneStripeGivesOneLineOverTheWholeImage) {
  const auto stripes = extract(render({stripe(100.3)}));
  ASSERT_EQ(stripes.size(), 1U);
  EXPECT_GE(stripes[0].points.size(), 190U);
  for (const StripePoint& p : stripes[0].points) {
    EXPECT_NEAR(p.x, 100.3, 0.05);
    EXPECT_NEAR(std::hypot(p.normal_x, p.normal_y), 1.0, 1e-9);
    EXPECT_NEAR(std::abs(p.normal_x), 1.0, 0.01);
    EXPECT_GT(p.sigma_px, 0);
    EXPECT_GT(p.strength, 0);
    // 2 sqrt(3) s = 6.93 px.
    EXPECT_NEAR(p.width, 6.93, 0.4);
    EXPECT_NEAR(p.intensity, 150, 15);
    EXPECT_EQ(p.flags & kStripeSaturated, 0);
  }
}

TEST_P(ExtractorContract, ShiftByAQuarterPixelShiftsTheAnswer) {
  const double at = mean_x(extract(render({stripe(100.0)}))),
               shifted = mean_x(extract(render({stripe(100.25)})));
  EXPECT_NEAR(shifted - at, 0.25, 0.01);
}

TEST_P(ExtractorContract, BrightnessDoesNotMoveTheCentre) {
  const double bright = mean_x(extract(render({stripe(100.3)}))),
               dark = mean_x(extract(render({stripe(100.3)}, 4, 0.4)));
  EXPECT_NEAR(bright, dark, 0.02);
}

TEST_P(ExtractorContract, OffsetDoesNotMoveTheCentre) {
  const double low = mean_x(extract(render({stripe(100.3)}))),
               high = mean_x(extract(render({stripe(100.3)}, 60)));
  EXPECT_NEAR(low, high, 0.02);
}

TEST_P(ExtractorContract, MirroredImageGivesMirroredPoints) {
  const Image8 image = render({stripe(90.3, 150, 8)});
  Image8 mirrored(image.width, image.height);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) mirrored(x, y) = image(image.width - 1 - x, y);
  EXPECT_NEAR(mean_x(extract(mirrored)), image.width - 1 - mean_x(extract(image)), 0.01);
}

TEST_P(ExtractorContract, TransposedImageGivesTransposedPoints) {
  const Image8 image = render({stripe(90.3, 150, 8)});
  Image8 transposed(image.height, image.width);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) transposed(y, x) = image(x, y);
  auto stripes = extract(transposed);
  ASSERT_EQ(stripes.size(), 1U);
  for (StripePoint& p : stripes[0].points) std::swap(p.x, p.y);
  EXPECT_NEAR(mean_x(stripes), mean_x(extract(image)), 0.01);
}

TEST_P(ExtractorContract, NoImageAndNoStripeGiveNoLines) {
  EXPECT_TRUE(extract_stripes(ImageView8{}, options()).stripes.empty());
  EXPECT_TRUE(extract(Image8(200, 100, 0)).empty());
  EXPECT_TRUE(extract(Image8(200, 100, 255)).empty());
  EXPECT_TRUE(extract(Image8(1, 1, 9)).empty());
  Canvas noise(200, 150, 20);
  EXPECT_TRUE(extract(noise.exposed(5, 0, 3)).empty());
}

TEST_P(ExtractorContract, SaturatedStripeIsFlaggedAndKeepsItsCentre) {
  const auto stripes = extract(render({stripe(100.3, 600)}));
  ASSERT_EQ(stripes.size(), 1U);
  for (const StripePoint& p : stripes[0].points) {
    EXPECT_NEAR(p.x, 100.3, 0.08);
    EXPECT_NE(p.flags & kStripeSaturated, 0);
  }
}

TEST_P(ExtractorContract, LineTouchingTheBorderIsFollowedToIt) {
  const auto stripes = extract(render({stripe(4.0, 150, 60)}));
  ASSERT_EQ(stripes.size(), 1U);
  EXPECT_LT(stripes[0].points.front().y, 2.5);
  EXPECT_GT(stripes[0].points.back().y, 196.5);
}

TEST_P(ExtractorContract, LongGapHasNoPoints) {
  Image8 image = render({stripe(100.3)});
  for (int y = 80; y < 120; ++y) std::fill(image.row(y), image.row(y) + image.width, std::uint8_t{4});
  int points = 0;
  for (const Stripe& s : extract(image))
    for (const StripePoint& p : s.points) {
      ++points;
      EXPECT_TRUE(p.y < 81 || p.y > 118) << p.y;
    }
  EXPECT_GE(points, 150);
}

TEST_P(ExtractorContract, TwoLinesStayTwo) {
  const auto stripes = extract(render({stripe(80.3), stripe(104.3)}));
  ASSERT_EQ(stripes.size(), 2U);
  EXPECT_NEAR(std::abs(stripes[0].points[50].x - stripes[1].points[50].x), 24, 0.05);
}

TEST_P(ExtractorContract, SameInputGivesTheSameBits) {
  Canvas canvas(240, 200, 5);
  canvas.add(stripe(100, 120, 30));
  const Image8 image = canvas.exposed(2, 0.05, 4);
  const auto a = extract(image), b = extract(image);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    ASSERT_EQ(a[k].points.size(), b[k].points.size());
    for (std::size_t i = 0; i < a[k].points.size(); ++i) {
      EXPECT_EQ(a[k].points[i].x, b[k].points[i].x);
      EXPECT_EQ(a[k].points[i].y, b[k].points[i].y);
      EXPECT_EQ(a[k].points[i].sigma_px, b[k].points[i].sigma_px);
    }
  }
}

TEST_P(ExtractorContract, SixteenBitsGiveTheSameLine) {
  const Image8 image = render({stripe(100.3)});
  Image16 wide(image.width, image.height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    wide.pixels[i] = static_cast<std::uint16_t>(image.pixels[i] * 16);
  const auto stripes = extract_stripes(wide.view(), options()).stripes;
  ASSERT_EQ(stripes.size(), 1U);
  EXPECT_NEAR(mean_x(stripes), mean_x(extract(image)), 0.01);
}

INSTANTIATE_TEST_SUITE_P(Methods, ExtractorContract,
                         testing::Values(ExtractionMethod::kDirectionGuided, ExtractionMethod::kSteger,
                                         ExtractionMethod::kZhouRoi, ExtractionMethod::kHuRecursive,
                                         ExtractionMethod::kCentroid, ExtractionMethod::kExtremum),
                         [](const auto& method) {
                           std::string name(enum_name(method.param));
                           std::erase(name, '-');
                           return name;
                         });

TEST(ExtractionOptions, OutOfRangeAreErrorsThatNameTheOption) {
  const Image8 image(20, 20, 0);
  const auto message = [&](const ExtractionOptions& o) -> std::string {
    try {
      extract_stripes(image.view(), o);
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  };
  ExtractionOptions o;
  EXPECT_EQ(message(o), "");
  o.sigma = -1;
  EXPECT_EQ(message(o).rfind("sigma", 0), 0U);
  o = {};
  o.stripe_width = 0.2;
  EXPECT_EQ(message(o).rfind("stripe_width", 0), 0U);
  o = {};
  for (const char* bad : {"", "20", "20,", "50,20", "a,b", "-1,5", "10,20x"}) {
    o.thresholds = bad;
    EXPECT_EQ(message(o).rfind("thresholds", 0), 0U) << bad;
  }
  o.thresholds = "10,20.5";
  EXPECT_EQ(message(o), "");
}

}  // namespace
}  // namespace lightstripe
