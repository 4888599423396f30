// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// How a rig's calibration may bend the sections that it measures.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

namespace lightstripe {

/// Independent errors of a calibration, each of 1 sigma, as what they do to a section (y, z of the rig frame,
/// mm) after its best rigid move: every sensor's points are displaced by polynomials of second degree.
struct SectionBends {
  static constexpr std::size_t kTerms = 6;  ///< 1, a, b, a^2, ab, b^2

  std::array<double, 2> centre_mm{};  ///< (y, z) from which a = y and b = z count
  double scale_mm = 100;              ///< one unit of a and b
  /// For each error, mm: sensor by sensor (in the rig's order) kTerms coefficients of the displacement along
  /// y, then kTerms of that along z.
  std::vector<std::vector<double>> bends;
};

/// 1, a, b, a^2, ab, b^2 at a place of the section.
std::array<double, SectionBends::kTerms> bend_terms(const SectionBends& bends, double y, double z);

/// By how much error `bend` displaces a point that `sensor` sees there, mm; nothing for a sensor that the
/// bend does not know.
Eigen::Vector2d displacement(const SectionBends& bends, std::size_t bend, int sensor, double y, double z);

}  // namespace lightstripe
