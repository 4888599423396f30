// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The memory of an extraction, kept from frame to frame.
#pragma once

#include <cstdint>
#include <type_traits>
#include <vector>

#include "extraction/curvature_bias.h"
#include "extraction/derivative_planes.h"
#include "extraction/direction_guided.h"
#include "extraction/grey_value_lines.h"
#include "extraction/kernels.h"
#include "extraction/line_set.h"
#include "extraction/line_tests.h"
#include "extraction/smoothing.h"

namespace lightstripe {

struct ExtractionWorkspace {
  DerivativeKernels kernels;  ///< of the last sigma
  LineSet lines;
  LineTestWorkspace tests;
  DirectionGuidedWorkspace<std::uint8_t> direction_guided8;
  DirectionGuidedWorkspace<std::uint16_t> direction_guided16;
  WholeImageWorkspace whole_image;
  GreyValueWorkspace grey_values;
  SmoothingWorkspace smoothing;
  BendWorkspace bends;
  std::vector<float> values;
  std::vector<Stripe> spare;  ///< memory of stripes that the last results did not need

  template <class T>
  DirectionGuidedWorkspace<T>& direction_guided() {
    if constexpr (std::is_same_v<T, std::uint8_t>)
      return direction_guided8;
    else
      return direction_guided16;
  }
};

}  // namespace lightstripe
