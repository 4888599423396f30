// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "core/section_bends.h"

namespace lightstripe {

std::array<double, SectionBends::kTerms> bend_terms(const SectionBends& bends, double y, double z) {
  const double a = (y - bends.centre_mm[0]) / bends.scale_mm, b = (z - bends.centre_mm[1]) / bends.scale_mm;
  return {1, a, b, a * a, a * b, b * b};
}

Eigen::Vector2d displacement(const SectionBends& bends, std::size_t bend, int sensor, double y, double z) {
  constexpr std::size_t kTerms = SectionBends::kTerms;
  const std::vector<double>& c = bends.bends[bend];
  const std::size_t from = 2 * kTerms * static_cast<std::size_t>(sensor);
  Eigen::Vector2d out = Eigen::Vector2d::Zero();
  if (sensor < 0 || from + 2 * kTerms > c.size()) return out;
  const auto terms = bend_terms(bends, y, z);
  for (std::size_t i = 0; i < kTerms; ++i)
    out += terms[i] * Eigen::Vector2d(c[from + i], c[from + kTerms + i]);
  return out;
}

}  // namespace lightstripe
