// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The memory of an extraction, kept from frame to frame.
#pragma once

#include <cstdint>
#include <type_traits>
#include <vector>

#include "extraction/compare/derivative_planes.h"
#include "extraction/compare/grey_value_lines.h"
#include "extraction/follow/direction_guided.h"
#include "extraction/follow/own_scale.h"
#include "extraction/kernels/kernels.h"
#include "extraction/lines/curvature_bias.h"
#include "extraction/lines/end_cuts.h"
#include "extraction/lines/faint_lines.h"
#include "extraction/lines/line_asymmetry.h"
#include "extraction/lines/line_ends.h"
#include "extraction/lines/line_filter.h"
#include "extraction/lines/line_noise.h"
#include "extraction/lines/line_set.h"
#include "extraction/lines/smoothing.h"
#include "extraction/track/look_through.h"

namespace lightstripe {

/// A line and the group of its scale.
struct PlacedLine {
  std::size_t group = 0;
  LineRange range;
};

struct ExtractionWorkspace {
  DerivativeKernels kernels;                  ///< of the last sigma that was given
  KernelCache kernel_cache;                   ///< of scales that were found
  ScaleGroups groups;                         ///< the lines under work
  std::vector<std::vector<LineFacts>> facts;  ///< one a group
  std::vector<FilteredLines> filtered;
  LineFilterWorkspace tests;
  DirectionGuidedWorkspace<std::uint8_t> direction_guided8;
  DirectionGuidedWorkspace<std::uint16_t> direction_guided16;
  WholeImageWorkspace whole_image;
  GreyValueWorkspace grey_values;
  ErrorWorkspace errors;
  AsymmetryWorkspace asymmetry;
  SmoothingWorkspace smoothing;
  LineEndWorkspace ends;
  BendWorkspace bends;
  EndCutWorkspace end_cuts;
  OwnScaleWorkspace<std::uint8_t> own_scale8;
  OwnScaleWorkspace<std::uint16_t> own_scale16;
  TrackWorkspace track;
  Image8 negative8;  ///< the image with dark lines made bright
  Image16 negative16;
  std::vector<PlacedLine> order;
  std::vector<float> values;
  std::vector<Stripe> spare;  ///< memory of stripes that the last results did not need

  template <class T>
  DirectionGuidedWorkspace<T>& direction_guided() {
    if constexpr (std::is_same_v<T, std::uint8_t>)
      return direction_guided8;
    else
      return direction_guided16;
  }
  template <class T>
  Image<T>& negative() {
    if constexpr (std::is_same_v<T, std::uint8_t>)
      return negative8;
    else
      return negative16;
  }
  template <class T>
  OwnScaleWorkspace<T>& own_scale() {
    if constexpr (std::is_same_v<T, std::uint8_t>)
      return own_scale8;
    else
      return own_scale16;
  }
};

}  // namespace lightstripe
