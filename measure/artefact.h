// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The size of a simple body of known size (a step, a cylinder, a ball) from what a rig saw of it: the daily
// check of the whole chain.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/fields.h"

namespace lightstripe {

enum class Artefact { kStep, kCylinder, kSphere };
constexpr std::array<EnumName<Artefact>, 3> enum_names(Artefact) {
  return {{{Artefact::kStep, "step"}, {Artefact::kCylinder, "cylinder"}, {Artefact::kSphere, "sphere"}}};
}

/// What is looked for; the points may show much else.
struct ArtefactSpec {
  Artefact kind = Artefact::kSphere;
  double size_mm = 0;    ///< known: height of the step, diameter of cylinder or ball
  bool section = false;  ///< one section only (the points' x is not used): no ball, a cylinder lies along x
};

struct ArtefactMeasurement {
  double size_mm = 0;
  double sigma_mm = 0;    ///< of the size, by leaving out parts of the points (jackknife)
  double scatter_mm = 0;  ///< rms of the points that were used about the shape
  int points = 0;         ///< that were used
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  ///< of a cylinder, unit
};

/// `points`: rig frame, mm; `groups`: for each point the part that it is left out with (frames of a scan,
/// pieces of a line), whose errors have nothing in common; not decreasing. At least 4 groups and 30 points.
///
/// step: the two parallel faces whose distance is within a tenth of the known height, and that hold most
/// points; common normal by total least squares; of a scan
/// without the sixth of each face at either end. cylinder, sphere: a first circle or ball within a twentieth
/// of the known size that explains most points (RANSAC; cylinders within about 20 degrees of an axis of the
/// rig frame), then least squares of the distances to the surface, points beyond 4 sigma left out. Sigma:
/// delete-one-group jackknife (Efron 1982) over the groups, or over eight parts of the body if that is
/// larger. Nothing where no such body is found, or where its points scatter by more than 0.5 % of the size or
/// leave it uncertain by more than 1 %: that is something else; `why_not` then says so.
std::optional<ArtefactMeasurement> measure_artefact(const std::vector<Eigen::Vector3d>& points,
                                                    const std::vector<int>& groups, const ArtefactSpec& spec,
                                                    std::string& why_not);

}  // namespace lightstripe
