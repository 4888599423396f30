// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/smoothing_spline.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

namespace lightstripe {
namespace {

std::vector<double> uneven_places(int count) {
  Random random(9);
  std::vector<double> places{0};
  while (static_cast<int>(places.size()) < count) places.push_back(places.back() + random.uniform(0.5, 1.5));
  return places;
}

TEST(SmoothingSpline, AParabolaStaysWhatItIs) {
  const auto places = uneven_places(80);
  std::vector<double> values;
  for (const double t : places) values.push_back(3 - 0.2 * t + 0.01 * t * t);
  const SmoothingSpline spline(places, std::vector<double>(places.size(), 1e6));
  const auto smooth = spline(values);
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(smooth[i], values[i], 1e-5);
}

TEST(SmoothingSpline, WithoutPenaltyTheValuesStay) {
  const auto places = uneven_places(30);
  Random random(1);
  std::vector<double> values;
  for (std::size_t i = 0; i < places.size(); ++i) values.push_back(random.gaussian());
  const auto smooth = SmoothingSpline(places, std::vector<double>(places.size(), 0))(values);
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(smooth[i], values[i], 1e-12);
}

TEST(SmoothingSpline, SpendsAsManyParametersAsItsMatrixHas) {
  const auto places = uneven_places(200);
  for (const double strength : {10.0, 1000.0}) {
    const std::vector<double> strengths(places.size(), strength);
    const SmoothingSpline spline(places, strengths);
    double trace = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      std::vector<double> unit(places.size(), 0);
      unit[i] = 1;
      trace += spline(unit)[i];
    }
    EXPECT_NEAR(spent_parameters(places, strengths) / trace, 1, 0.12) << strength;
  }
}

TEST(SmoothingSpline, NoiseIsThatOfTheValuesNotOfTheirCurve) {
  Random random(5);
  std::vector<double> values;
  for (int i = 0; i < 2000; ++i) values.push_back(10 * std::sin(0.02 * i) + 0.3 * random.gaussian());
  EXPECT_NEAR(difference_noise(values), 0.3, 0.02);
}

}  // namespace
}  // namespace lightstripe
