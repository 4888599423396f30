// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Equivalent conicity: the cone whose wave is as long as that of the wheelset at the same amplitude.
#pragma once

#include <optional>
#include <vector>

namespace lightstripe {

/// The rolling radius difference (right less left) over the lateral shift, even steps.
struct RadiusDifference {
  double first_mm = 0, step_mm = 0.1;
  std::vector<double> delta_r_mm;

  double last_mm() const { return first_mm + step_mm * static_cast<double>(delta_r_mm.size() - 1); }
  double at(double shift) const;  ///< straight between two nodes
};

/// Klingel's equation y'' = -delta_r(y) / (2 e r0) (EN 15302, UIC 519): a wheelset that starts at rest at one
/// end of its wave turns round where it has lost what it won, and tan gamma_e = (2 pi / wavelength)^2 e r0.
/// The amplitude is half of the way between the two turning points; the wave runs about where the radii are
/// equal. Nothing where the differences are not known so far, or the wave does not come back.
class KlingelWave {
 public:
  explicit KlingelWave(const RadiusDifference& difference);
  std::optional<double> tan_gamma_e(double amplitude_mm) const;
  /// Where the radii are equal.
  std::optional<double> middle_mm() const { return middle_; }

 private:
  double turning_point(double energy, bool right) const;

  std::vector<double> shift_, potential_;  ///< fine steps; the integral of delta_r / 2 from the middle
  std::vector<double> left_, right_;       ///< its rising envelope from the middle outwards
  std::size_t middle_index_ = 0;
  std::optional<double> middle_;
};

}  // namespace lightstripe
