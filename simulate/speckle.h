// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The grain of laser light on a rough surface, as a camera sees it (subjective speckle).
#pragma once

#include <cstdint>

#include "core/fields.h"
#include "core/image.h"

namespace lightstripe {

/// How coarse and how strong the grain is. Real pictures: contrast 0.15 to 0.6, grain 0.8 to 3 px.
struct Speckle {
  double contrast = 0;    ///< standard deviation / mean of even light, 0 (none) to 1 (fully coherent)
  double grain_px = 1.2;  ///< g: the intensity's correlation over d px is exp(-d^2 / (2 g^2))
};

template <class V>
void visit_fields(V&& v, Speckle& o) {
  v("contrast", o.contrast,
    "standard deviation / mean of even laser light; 0: no speckle, 1: fully coherent");
  v("grain_px", o.grain_px, "g of the intensity's correlation exp(-d^2 / (2 g^2)), px");
}

/// Multiplies the laser's part of a picture by a speckle pattern of mean 1: adds laser * (pattern - 1) to
/// `light`, where both have the same size, grey levels.
///
/// A fully developed pattern is the squared modulus of a circular complex Gaussian field that the pupil
/// low-passes (Goodman, Speckle Phenomena in Optics, chapters 3 and 4); here the pupil is a Gaussian. The
/// pattern is the weighted mean of as many independent ones as give the contrast: M = 1 / contrast^2 looks,
/// the last with less weight where M is no whole number. Its values hold for pixel centres: what the pixel's
/// area averages is part of `contrast`. The same seed and stream give the same bits, whatever the order of
/// calls.
void add_speckle(const Image<float>& laser, const Speckle& speckle, std::uint64_t seed, std::uint64_t stream,
                 Image<float>& light);

}  // namespace lightstripe
