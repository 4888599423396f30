// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Where in the points an artefact of known size is, roughly: random samples (RANSAC), judged by how many
// points they explain. The same points give the same answer.
#pragma once

#include <optional>
#include <vector>

#include "measure/artefact.h"
#include "measure/artefact_fit.h"

namespace lightstripe {

inline constexpr double kStepTolerance = 0.1;  // of the known height

/// At most some 3000 points, without the plane (of a section: the straight line) that most bodies stand on,
/// where it holds a third of the points or more.
Points3 points_to_search(const Points3& points, const ArtefactSpec& spec);

/// Directions to try, by groups: about each of the rig's axes, 6 degrees apart; of a ball none, of a section
/// the travel.
std::vector<std::vector<Eigen::Vector3d>> axes_of_round_body(const ArtefactSpec& spec);

/// How well the body explains the points: 1 for each on its surface, 0 from `width` on (MSAC: Torr and
/// Zisserman 2000).
double support_of(const Points3& points, const RoundBody& body, double width);

/// The body within a twentieth of the known size that explains most points; radius 0: none. A cylinder at a
/// slant to the axis is seen as an ellipse first: hence the width of what counts.
RoundBody find_round_body(const Points3& points, const ArtefactSpec& spec,
                          const std::vector<Eigen::Vector3d>& axes);

/// The two parallel faces at about the known distance that hold most points.
std::optional<ParallelFaces> find_step(const Points3& points, const ArtefactSpec& spec);

}  // namespace lightstripe
