// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// One measured section as the measurements see it: points in the plane, chained as they follow each other.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/profile.h"

namespace lightstripe {

struct SectionPoint {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< u, v, mm
  int chain = 0;        ///< points of one stripe of one sensor, in order along it, share this number
  int sensor = 0;       ///< who saw it
  double sigma_mm = 0;  ///< predicted 1-sigma error, 0: not known
  double weight = 1;    ///< below 1 where the predicted error is far above the section's usual one (glare)
};

using Section = std::vector<SectionPoint>;

/// The points of a profile; every stripe of every sensor becomes a chain.
Section section_of(const Profile& profile);

/// Whether v is a radius: true where u and v are those of a turn about one fixed axis (rotary motion), which
/// the positions themselves prove; false where they are two axes of the rig frame, or where it cannot be
/// told.
bool sections_are_radial(const std::vector<Profile>& profiles);

}  // namespace lightstripe
