// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The PNG pictures that cameras write, decoded in one go: plain grey, 8 or 16 bits, not interlaced.
#pragma once

#include <optional>
#include <string_view>

#include "core/image.h"

namespace lightstripe {

/// The picture; nothing where it is of another kind, or its pixels are not what its header says. `bytes` have
/// to have passed inspect_image(): whole, checksums right, size within limits. PNG specification (second
/// edition), sections 9 (filters) and 10 (deflate).
std::optional<GreyImage> decode_grey_png(std::string_view bytes);

}  // namespace lightstripe
