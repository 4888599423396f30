// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/adjust/lens_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace lightstripe {
namespace {

std::set<std::string_view> terms_of(LensModel lens) {
  std::set<std::string_view> names;
  for (const int term : free_terms(lens)) names.insert(kTermNames.at(static_cast<std::size_t>(term)));
  return names;
}

TEST(LensModel, HasTheTermsOfItsName) {
  using Names = std::set<std::string_view>;
  EXPECT_EQ(terms_of(LensModel::kPinhole), Names{});
  EXPECT_EQ(terms_of(LensModel::kBrown4), (Names{"k1", "k2", "p1", "p2"}));
  EXPECT_EQ(terms_of(LensModel::kBrown5), (Names{"k1", "k2", "p1", "p2", "k3"}));
  EXPECT_EQ(terms_of(LensModel::kRational), (Names{"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"}));
  EXPECT_EQ(terms_of(LensModel::kTilted), (Names{"k1", "k2", "tau_x", "tau_y"}));
  EXPECT_EQ(terms_of(LensModel::kTiltedRational),
            (Names{"k1", "k2", "k3", "k4", "k5", "k6", "tau_x", "tau_y"}));
}

TEST(LensModel, ATiltedOneHasNoDecentring) {
  for (const auto& [lens, name] : enum_names(LensModel{})) {
    const auto names = terms_of(lens);
    EXPECT_EQ(names.contains("tau_x"), has_tilt(lens)) << name;
    EXPECT_FALSE(names.contains("tau_x") && names.contains("p1")) << name;
  }
}

}  // namespace
}  // namespace lightstripe
