// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What may have happened to pictures whose stripes do not agree: laser pictures of other poses, pictures
// turned or mirrored.
#pragma once

#include <string>
#include <vector>

#include "calib/start/stripe_planes.h"

namespace lightstripe {

/// Tries the laser pictures with the boards of other poses (shifted by up to 3, reversed): a sentence where
/// most stripes then agree, and far more than now; otherwise empty.
std::string guess_pairing(const InitialValues& values, const std::vector<StripeInSpace>& stripes,
                          std::size_t agreeing);

/// A stripe off the plane of the others: names the board whose pose it fits, if there is exactly one;
/// otherwise empty.
std::string guess_partner(const InitialValues& values, const StripeInSpace& stripe, const Plane& laser);

/// Throws NotUsable where the stripes off the plane lie in that plane turned by 180 degrees about the
/// camera's axis, or mirrored: then so are their pictures.
void refuse_flipped_pictures(const InitialValues& values, const std::vector<StripeInSpace>& stripes,
                             const std::vector<const StripeInSpace*>& kept, const Plane& laser,
                             const std::string& name);

}  // namespace lightstripe
