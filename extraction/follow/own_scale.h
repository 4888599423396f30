// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Direction-guided following where nobody said how wide the stripes are: each line at its own scale.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "extraction/follow/direction_guided.h"
#include "extraction/follow/follow_tuning.h"
#include "extraction/follow/scale_ladder.h"
#include "extraction/follow/scale_seeds.h"
#include "extraction/follow/seed_chains.h"
#include "extraction/lines/line_set.h"

namespace lightstripe {

/// Lines that are followed at one scale.
struct ScaleGroup {
  const DerivativeKernels* kernels = nullptr;         ///< of the lines' scale in the image's own pixels
  const DerivativeKernels* binned_kernels = nullptr;  ///< the same in those of the pyramid's level
  int level = 0;                                      ///< of the pyramid, in which they are followed
  RidgeLimits limits;
  LineSet lines;
};

/// Groups of one image; those from `count` on only keep their memory.
struct ScaleGroups {
  std::vector<ScaleGroup> all;
  std::size_t count = 0;
  std::size_t rejected = 0;  ///< lines that were followed and are in no group

  /// An empty one more.
  ScaleGroup& add(const DerivativeKernels& kernels) {
    if (count == all.size()) all.emplace_back();
    ScaleGroup& group = all[count++];
    group.kernels = group.binned_kernels = &kernels;
    group.level = 0;
    group.lines.clear();
    return group;
  }
  std::span<ScaleGroup> used() { return {all.data(), count}; }
};

template <class T>
struct OwnScaleWorkspace {
  ImagePyramid<T> pyramid;
  std::vector<ScaleSeed> found, seeds, chained;
  SeedChainWorkspace chains;
  /// One a level: cells in which no line begins.
  std::array<std::vector<std::uint8_t>, ImagePyramid<T>::kMostLevels> tried;
  /// Cells of 4 x 4 pixels beside lines that were followed; bit k: no seed of level k is tried there.
  std::vector<std::uint8_t> blocked;
  std::vector<StripePoint> binned_points;
  /// Of a line that is taken back for another try.
  std::vector<StripePoint> lifted_points;
  std::vector<ExclusionMask::Mark> lifted_marks;
  std::vector<float> values;
};

/// A search in parts of the image only.
struct WindowedSearch {
  const SearchWindows* seeds = nullptr;  ///< where lines begin
  const SearchWindows* seen = nullptr;   ///< these and their surroundings, which coarse kernels look at
  LevelNoise noise{};
  int coarsest = 0;  ///< level of the pyramid in which lines begin
};

/// What is asked of the lines, and how the image is.
template <class T>
struct OwnScaleSearch {
  ImageView<T> image;
  double noise = 0;         ///< grey levels, as seen in the image
  double brightest = 0;     ///< grey level
  double least_widths = 5;  ///< shortest line, in full stripe widths
  int stop_after = 0;       ///< lines; 0 = all
  FollowTuning tuning;
  const WindowedSearch* windowed = nullptr;  ///< null: the whole image
};

/// Makes the limits for the kernels of one scale.
struct LimitsMaker {
  const void* facts;
  RidgeLimits (*make)(const void* facts, const DerivativeKernels& kernels, double noise);
  /// `noise`: as seen in the level of the pyramid, grey levels.
  RidgeLimits operator()(const DerivativeKernels& kernels, double noise) const {
    return make(facts, kernels, noise);
  }
};

/// Appends the lines of `search.image` to `groups`. Where two scales claim one place, the line with the
/// larger contrast comes first and keeps it.
template <class T>
void follow_lines_at_own_scale(const OwnScaleSearch<T>& search, const LimitsMaker& limits,
                               KernelCache& kernels, DirectionGuidedWorkspace<T>& following,
                               OwnScaleWorkspace<T>& workspace, ScaleGroups& groups);

}  // namespace lightstripe
