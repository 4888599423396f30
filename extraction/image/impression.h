// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What a picture in which no line was found looks like: a refusal that says why, and what to do.
#pragma once

#include <cstddef>
#include <string_view>

#include "extraction/image/thresholds.h"

namespace lightstripe {

enum class Impression {
  kNone,         ///< lines were found, or nobody looked
  kOverexposed,  ///< a large part of the picture is clipped
  kDark,         ///< nothing in it is bright
  kEven,         ///< nothing stands out of it
  kNoise,        ///< crowds of short crumbs
  kEdges,        ///< edges of lit things, which are bright on one side only
  kTooFaint,     ///< what stands out is too short, too faint or too uneven
};

/// What the search met.
struct ImpressionFacts {
  double noise = 0;         ///< grey levels
  double full_scale = 255;  ///< grey level at which pixels are clipped
  std::size_t tried = 0;    ///< lines that were followed, and dropped
  double edge_length = 0;   ///< px, of those that are bright on one side only
};

/// For a picture without lines.
Impression impression_of(const Histogram& histogram, const ImpressionFacts& facts);

/// "it looks like noise: ..."; empty for kNone.
std::string_view what_it_looks_like(Impression impression);
/// What to do about it, with the command line's options.
std::string_view what_to_do_about(Impression impression);

}  // namespace lightstripe
