// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "io/image_header.h"

namespace lightstripe {

/// The first directory of a TIFF or BigTIFF file: size, and whether all strips or tiles lie within the file.
ImageHeader inspect_tiff(std::string_view bytes);

}  // namespace lightstripe
