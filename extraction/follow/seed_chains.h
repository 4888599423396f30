// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Which of many seeds lie in a row: in a picture full of bright things a faint line shows by its length.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "extraction/follow/scale_seeds.h"

namespace lightstripe {

/// Scratch memory: cells of one level of the pyramid.
struct SeedChainWorkspace {
  std::vector<std::uint8_t> taken;
  std::vector<std::int16_t> gains, forward, backward;
  std::vector<std::int32_t> length;  ///< px, of each seed's chain
};

/// Those of the `seeds` of an image of width x height px that lie in chains of at least `least_length` px;
/// the longest chain first, equals in their order. A chain runs from cell to neighbouring cell of one level
/// along the rows or along the columns, at 45 degrees at most; a gap costs as much as it is long, and what
/// has others close to both of its sides is a texture's and counts as a gap.
void collect_chained_seeds(std::span<const ScaleSeed> seeds, int width, int height, int least_length,
                           SeedChainWorkspace& workspace, std::vector<ScaleSeed>& chained);

}  // namespace lightstripe
