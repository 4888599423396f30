// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Sections for tests: points of an outline as two sensors above see them, moved, with noise.
#pragma once

#include <Eigen/Geometry>
#include <numbers>

#include "core/outline.h"
#include "core/random.h"
#include "measure/section.h"

namespace lightstripe {

struct SectionRecipe {
  double spacing_mm = 0.3;
  double noise_mm = 0;
  double bend_mm = 0, bend_length_mm = 3;  ///< error that neighbours share: sd, length of the Gaussian
  double turn_deg = 0;
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  bool right = true, left = true;  ///< what the sensor at +u, at -u sees
  bool lower_part = true;          ///< below the head
  std::uint64_t seed = 1;
};

/// What bends a section of `count` points, across it.
inline std::vector<double> bend_of(std::size_t count, const SectionRecipe& recipe, Random& random) {
  std::vector<double> out(count, 0.0);
  if (recipe.bend_mm <= 0) return out;
  const int reach = static_cast<int>(3 * recipe.bend_length_mm / recipe.spacing_mm);
  std::vector<double> kernel, white;
  double squares = 0;
  for (int k = -reach; k <= reach; ++k) {
    const double x = k * recipe.spacing_mm / recipe.bend_length_mm;
    kernel.push_back(std::exp(-x * x)), squares += kernel.back() * kernel.back();
  }
  for (std::size_t i = 0; i < count + kernel.size(); ++i) white.push_back(random.gaussian());
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < kernel.size(); ++k)
      out[i] += recipe.bend_mm * kernel[k] * white[i + k] / std::sqrt(squares);
  return out;
}

/// Points of a rail's outline that a sensor up and aside sees: normals that look towards it, and nothing
/// under the head down to 70 below the top (shadow), as in the simulated rig.
inline Section rail_section(const Outline& rail, const SectionRecipe& recipe) {
  Random random(recipe.seed);
  Section section;
  for (int sensor = 0; sensor < 2; ++sensor) {
    if (!(sensor == 0 ? recipe.right : recipe.left)) continue;
    const Eigen::Vector2d towards = Eigen::Vector2d(sensor == 0 ? 1 : -1, 0.7).normalized();
    const auto points = sample(rail, recipe.spacing_mm);
    const std::vector<double> bend = bend_of(points.size(), recipe, random);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::Vector2d &p = points[i].position, &n = points[i].normal;
      const bool head = p.y() > -38, shadow = !head && p.y() > -70;
      if (n.dot(towards) < 0.2 || shadow || (!head && !recipe.lower_part)) continue;
      if (!head && p.x() * towards.x() < 0) continue;
      const Eigen::Vector2d seen = p + (bend[i] + recipe.noise_mm * random.gaussian()) * n;
      const Eigen::Vector2d moved =
          Eigen::Rotation2Dd(recipe.turn_deg * std::numbers::pi / 180) * seen + recipe.shift;
      section.push_back({moved, 2 * sensor + (head ? 0 : 1), sensor, 0, 1});
    }
  }
  return section;
}

/// A wheel's outline above `lowest_v`.
inline Section wheel_section(const Outline& wheel, double lowest_v, const SectionRecipe& recipe,
                             bool mirrored = false) {
  Random random(recipe.seed);
  Section section;
  std::vector<OutlineSample> outline;  // pieces shorter than the spacing give too many
  for (const OutlineSample& point : sample(wheel, recipe.spacing_mm))
    if (outline.empty() || (point.position - outline.back().position).norm() > 0.9 * recipe.spacing_mm)
      outline.push_back(point);
  const std::vector<double> bend = bend_of(outline.size(), recipe, random);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const OutlineSample& point = outline[i];
    if (point.position.y() < lowest_v) continue;
    Eigen::Vector2d p = point.position + (bend[i] + recipe.noise_mm * random.gaussian()) * point.normal;
    if (mirrored) p.x() = -p.x();
    section.push_back(
        {Eigen::Rotation2Dd(recipe.turn_deg * std::numbers::pi / 180) * p + recipe.shift, 0, 0, 0, 1});
  }
  return section;
}

/// As profiles.csv has it; every chain is a line of its sensor.
inline Profile profile_of(const Section& section, double travel = 0) {
  Profile profile;
  profile.travel = travel;
  for (const SectionPoint& point : section) {
    ProfilePoint p;
    p.u = point.position.x(), p.v = point.position.y();
    p.sensor = point.sensor, p.line = point.chain;
    profile.points.push_back(p);
  }
  return profile;
}

}  // namespace lightstripe
