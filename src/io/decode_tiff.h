// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The first page of a TIFF file -> pixels, by libtiff; inside src/io.
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <string_view>

namespace lightstripe {

struct TiffPicture {
  cv::Mat pixels;  ///< grey or BGR, 8 or 16 bits, as they lie in the file: the tag Orientation is not obeyed
  int white = 0;   ///< the largest value that the bits can hold where that is known (9 to 15 bits), else 0
};

/// Decodes whole-number samples of 1 or 8 to 16 bits: grey (also WhiteIsZero) and RGB, in strips or tiles,
/// interleaved or in planes, alpha and other extra samples left out; palettes, YCbCr, CMYK and Lab of 8 bits
/// by libtiff's own conversion. An Error naming `name` with the reason for every other file.
TiffPicture decode_tiff(std::string_view bytes, const std::string& name);

}  // namespace lightstripe
