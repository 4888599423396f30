// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Less scatter by the neighbours along the line, without bending it.
#pragma once

#include <array>
#include <vector>

#include "extraction/lines/band_matrix.h"
#include "extraction/lines/line_set.h"

namespace lightstripe {

/// Scratch memory.
struct SmoothingWorkspace {
  /// Every few points of a stretch one that moves; the others move as the nodes beside them.
  struct Node {
    double x = 0, y = 0, normal_x = 1, normal_y = 0;
    double noise = 1;     ///< px^2: variance of what the points around it tell
    double aside = 0;     ///< px along the normal: the estimate
    double variance = 0;  ///< px^2, of the estimate
  };
  /// How much the bend changes from one node to the next three: a third difference across the line.
  struct Change {
    std::array<double, 4> factors{};  ///< of the four nodes' places along their normals
    double seen = 0;                  ///< px, of the points as they are
    double expected = 0;              ///< px^2: variance of the curve's
    double square = 0;                ///< px^2: what the points make of it
  };
  std::vector<Node> nodes;
  std::vector<Change> changes;
  BandMatrix noise;  ///< px^2: covariance of what it adds to the changes
  BandMatrix factor, inverse;
  std::vector<double> solution;
  std::vector<float> sigmas;
};

/// Each point moves across its line onto a curve whose bend changes as little, and at as few places, as the
/// points allow: third differences of the curve are Gaussian with a variance of their own at every place, and
/// the variances are those that make the points likeliest (automatic relevance determination: Tipping, J.
/// Mach. Learn. Res. 1, 2001, by expectation maximisation; the same curves as by trend filtering: Kim, Koh,
/// Boyd, Gorinevsky, SIAM Rev. 51, 2009). Straight stretches and arcs become far surer, bends that change
/// hardly, corners not at all. Errors count as correlated over LineRange::shared_px, which must be known as
/// sigma_px must; sigma_px falls to that of the curve. Gaps and long bridges end a stretch, and points near
/// its ends that are clearly less sure than the line stay as they are.
void smooth_along_lines(LineSet& lines, SmoothingWorkspace& workspace);

}  // namespace lightstripe
