// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The bytes of a picture file -> grey values, inside src/io.
#pragma once

#include <string>
#include <string_view>

#include "io/images.h"

namespace lightstripe {

enum class Bits { kKept, kReducedTo8 };

/// Looks at the header, then decodes. `name` stands in messages. An Error as read_image() says. 16-bit grey
/// pictures become 8-bit ones only where `bits` says so. With kAuto `chosen`, if not null, tells which
/// channel was taken.
GreyImage decode_picture(std::string_view bytes, const std::string& name, Channel channel, Bits bits,
                         Channel* chosen = nullptr);

}  // namespace lightstripe
