// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Where the light of a stripe ends, told by the strength of a line's last points, and what that end does to
// the points near it.
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace lightstripe {

/// The end of a stripe of standard deviation `width`, cut off by the edge of a body or of a shadow, seen by
/// kernels of `sigma`. z counts in spread() from the end on, inwards.
struct LightEnd {
  double sigma = 1;    ///< px
  double width = 1;    ///< px
  double tangent = 1;  ///< magnitude of the cut's tangent, as far as the strengths tell it
  double inside = 0;   ///< z of the line's first point

  /// Over which the strength falls, px: more than sigma for an oblique cut.
  double spread() const;

  /// A kernel's share that is lit.
  static double share(double z);
  /// The ridge's shift aside over the cut's tangent, px: the lit part of the kernel has its centre there, s^2
  /// times the slope of the strength's logarithm, and the ridge runs obliquely up the falling strength. Right
  /// to 12 % from z = 1 on for tangents of 1 and 2.
  double shift(double z) const;
  /// A point's strength over that far inside: the lit share where the ridge runs, and what is left of the
  /// profile is narrower.
  double strength(double z) const;
  /// By how much speckle scatters a point more where only a part of its kernel is lit.
  static double scatter(double z);
};

/// What an end does to a point.
struct EndInfluence {
  double shift = 0;    ///< LightEnd::shift, px
  double scatter = 1;  ///< LightEnd::scatter
};

struct EndTable;

/// The same from tables, to some 3 %.
class EndCurves {
 public:
  explicit EndCurves(const LightEnd& light);
  EndInfluence at(double z) const;

 private:
  const EndTable* table_;
  double gain_;
};

/// Beyond that an end is not seen.
inline constexpr double kFarthestInside = 2.5;

/// Tangents that LightEnd::tangent may have for the tables: beyond the last one a cut only gets longer.
inline constexpr std::array<double, 3> kEndTangents{0.5, 1, 2};

/// Points whose strengths fit_light_end() wants, and how many of them there are in a spread.
inline constexpr std::size_t kEndSamplesPerSpread = 4, kEndSamples = 3 * kEndSamplesPerSpread + 1;

/// What fits strengths best.
struct EndOfStrength {
  double inside = kFarthestInside;  ///< z of the first one; kFarthestInside where the strength does not fall
  double misfit = 0;                ///< sum of the squared differences of the logarithms
};
/// `strengths`: from the line's first point inwards, kEndSamplesPerSpread of them a spread of `light`. Their
/// level further in is unknown and may be any.
EndOfStrength fit_light_end(const LightEnd& light, std::span<const double, kEndSamples> strengths);

}  // namespace lightstripe
