// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What each of a rail's quantities scatters by over many noisy sections, against the sigma that goes with it.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "io/nominal_outlines.h"
#include "measure/measure_profile.h"
#include "sections.h"
#include "simulate/worn_rail.h"

namespace lightstripe {
namespace {

/// Of 150 repeats, which know a variance to 12 %: scatter over prediction, by quantity.
std::map<std::string, double> variance_ratios(const Outline& rail, SectionRecipe recipe) {
  constexpr int kRepeats = 150;
  const ReferenceShape reference{"60E1", ObjectKind::kRail, read_nominal("60E1")};
  std::map<std::string, std::vector<Estimate>> all;
  for (int i = 0; i < kRepeats; ++i) {
    recipe.seed = static_cast<std::uint64_t>(i + 1);
    const MeasuredFrame row =
        measure_profile(profile_of(rail_section(rail, recipe)), {reference, {}, {}}, {});
    for (const auto* list : {&row.estimates, &row.extras})
      for (const NamedEstimate& one : *list)
        if (one.estimate.value && one.estimate.sigma) all[one.name].push_back(one.estimate);
  }
  std::map<std::string, double> ratios;
  for (const auto& [name, estimates] : all) {
    const auto n = static_cast<double>(estimates.size());
    double mean = 0, scatter = 0, said = 0;
    for (const Estimate& e : estimates) mean += *e.value / n;
    for (const Estimate& e : estimates)
      scatter += std::pow(*e.value - mean, 2) / (n - 1), said += std::pow(*e.sigma, 2) / n;
    ratios[name] = scatter / said;
  }
  return ratios;
}

// Independent noise, and stripes that bend over one millimetre and over several, each sensor's by itself. A
// sigma that is 0.7 or 1.4 times what it is falls out on either side.
TEST(RailSigmas, AreWhatTheQuantitiesScatterByAlsoOnBentStripes) {
  const Outline nominal = read_nominal("60E1");
  for (const Outline& rail : {nominal, worn_rail(nominal, 2, 1.5)})
    for (const SectionRecipe& recipe :
         {SectionRecipe{.spacing_mm = 0.25, .noise_mm = 0.02},
          SectionRecipe{.spacing_mm = 0.2, .noise_mm = 0.01, .bend_mm = 0.02, .bend_length_mm = 0.7},
          SectionRecipe{.spacing_mm = 0.2, .noise_mm = 0.01, .bend_mm = 0.02, .bend_length_mm = 3}}) {
      const auto ratios = variance_ratios(rail, recipe);
      for (const std::string name :
           {"vertical_wear", "side_wear", "corner45_wear", "head_width", "head_area_loss", "gauge_face_angle",
            "inclination", "crown_radius", "overlap_gap"}) {
        EXPECT_GT(ratios.at(name), 0.65)
            << name << ", bend " << recipe.bend_mm << " over " << recipe.bend_length_mm;
        EXPECT_LT(ratios.at(name), 1.38)
            << name << ", bend " << recipe.bend_mm << " over " << recipe.bend_length_mm;
      }
    }
}

}  // namespace
}  // namespace lightstripe
