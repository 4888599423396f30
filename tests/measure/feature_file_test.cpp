// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/feature_file.h"

#include <gmock/gmock.h>

#include "core/error.h"

namespace lightstripe {
namespace {

using ::testing::HasSubstr;

/// Two lines, their crossing, and a quantity of each kind of use.
FeatureFile good_file() {
  FeatureRecipe low, high, edge;
  low.name = "low", low.u = {-20, -2};
  high.name = "high", high.u = {2, 20};
  edge.name = "edge", edge.type = FeatureType::kIntersection, edge.of = {"low", "high"};
  QuantityRecipe step, place;
  step.name = "step", step.type = QuantityType::kStepHeight, step.of = {"low", "high"};
  place.name = "place", place.type = QuantityType::kPositionU, place.of = {"edge"};
  AlongRecipe flat;
  flat.name = "flat", flat.of = {"low"};
  return {{low, high, edge}, {step, place}, {flat}};
}

/// What check() says of the file; empty: nothing is wrong.
std::string complaint(const FeatureFile& file) {
  try {
    file.check("f.yaml");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(FeatureFile, ThatFitsIsTaken) { EXPECT_EQ(complaint(good_file()), ""); }

TEST(FeatureFile, NamesHaveToBeThereOnceAndBeforeTheirUse) {
  FeatureFile file = good_file();
  file.measurements[0].of = {"low", "hihg"};
  EXPECT_THAT(complaint(file), HasSubstr("asks for the feature 'hihg'"));
  file = good_file();
  std::swap(file.features[1], file.features[2]);
  EXPECT_THAT(complaint(file),
              HasSubstr("f.yaml: edge: asks for the feature 'high', which is not named before it"));
  file = good_file();
  file.features[1].name = "low";
  EXPECT_THAT(complaint(file), HasSubstr("is named twice"));
  file = good_file();
  file.measurements[1].name = "step";
  EXPECT_THAT(complaint(file), HasSubstr("is measured twice"));
  file = good_file();
  file.features[0].name.clear();
  EXPECT_THAT(complaint(file), HasSubstr("has no name"));
}

TEST(FeatureFile, FeaturesHaveToFitTheirUse) {
  FeatureFile file = good_file();
  file.measurements[0].type = QuantityType::kRadius, file.measurements[0].of = {"low"};
  EXPECT_THAT(complaint(file), HasSubstr("needs 'low' to be of the type arc"));
  file = good_file();
  file.measurements[0].of = {"low"};
  EXPECT_THAT(complaint(file), HasSubstr("names 1 feature, 2 needed"));
  file = good_file();
  file.measurements[0].of = {"edge", "low"};
  EXPECT_THAT(complaint(file), HasSubstr("needs 'edge' to be of the type line"));
  file = good_file();
  file.along[0].of = {"edge"};
  EXPECT_THAT(complaint(file), HasSubstr("needs 'edge' to be of the type line"));
  file = good_file();
  file.along[0].of = {"low", "high"};
  EXPECT_THAT(complaint(file), HasSubstr("names the wrong number of features"));
}

TEST(FeatureFile, RangesGoFromLowToHighAndSomethingIsMeasured) {
  FeatureFile file = good_file();
  file.features[0].u = {5, 1};
  EXPECT_THAT(complaint(file), HasSubstr("f.yaml: low.u: is no range"));
  file = good_file();
  file.measurements.clear(), file.along.clear();
  EXPECT_THAT(complaint(file), HasSubstr("f.yaml: measurements: are missing"));
}

}  // namespace
}  // namespace lightstripe
