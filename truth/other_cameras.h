// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Pictures as another camera would have taken them: ranges, exposures, tone curves, lenses, codecs, noise and
// colours that the labelled pictures do not have. A way to see what hangs on the cameras that were looked at.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "io/images.h"

namespace lightstripe {

struct OtherCamera {
  std::string_view name;
  std::string (*imitate)(const RgbImage&);  ///< the picture's file, in memory: PPM or JPEG
};

/// All of one size and place: labels stay true.
std::span<const OtherCamera> other_cameras();

/// The one of that name, which exists.
const OtherCamera& other_camera(std::string_view name);

/// A picture as that camera would have given it, read as any file is; channel chosen by itself.
Image8 imitated(const OtherCamera& camera, const RgbImage& picture);

}  // namespace lightstripe
