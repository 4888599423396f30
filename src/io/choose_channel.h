// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Which channel a whole sequence takes where the scan says auto, inside src/io.
#pragma once

#include <cstdint>
#include <functional>

#include "io/images.h"

namespace lightstripe {

/// The first picture of a few, spread over the sequence, that shows a colour decides: the line may not be
/// there yet at the start of a scan. `look(index, chosen)` reads one with kAuto; pictures that give an Error
/// are passed over.
Channel decide_channel(std::int64_t count, const std::function<void(std::int64_t, Channel*)>& look);

}  // namespace lightstripe
