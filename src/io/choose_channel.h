// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Which channel a whole sequence takes where the scan says auto, inside src/io.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "io/images.h"

namespace lightstripe {

/// What most of a few pictures, spread over the sequence, are read as; those that show no colour abstain,
/// because the line may not be in every picture. `look(index, chosen)` reads one with kAuto; pictures that
/// give an Error are passed over.
Channel decide_channel(std::int64_t count, const std::function<void(std::int64_t, Channel*)>& look);

/// The votes of several pictures counted: the commonest of those that are not gray, the first one among
/// equals; of one colour the "-clipped" form if a third of its votes are for it, else the "-textured" one if
/// more than half are.
Channel count_votes(std::span<const Channel> votes);

}  // namespace lightstripe
