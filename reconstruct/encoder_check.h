// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What an encoder's table says that no rig can have done: counters that wrap, values that stand for an error,
// jumps, counters that stick.
#pragma once

#include <string>
#include <vector>

#include "reconstruct/travel.h"

namespace lightstripe {

struct CheckedReadings {
  TravelReadings readings;            ///< without the values that no rig can have; wraps undone where certain
  std::vector<std::string> warnings;  ///< each names its frames
};

/// Looks at the steps from reading to reading against their median (per frame, of those that are not 0):
/// - a value more than 1000 steps away from both neighbours, which agree with each other, is left out, so
/// that
///   the frame's travel is interpolated;
/// - a step that is the usual one but for 2^16 or 2^32 counts, from one end of the counter's range to the
///   other, the counts being whole parts of the table's finest digit and only one such length fitting, is a
///   wrap and undone in all later readings;
/// - any other step of more than 20 usual ones, one of more than 3 against those before and behind it (a
///   counter that was reset), and travel that stands still over three frames or more, is only named.
/// Angles may begin anew at a full turn. Fewer than four steps tell nothing but that the travel stands still.
CheckedReadings check_encoder(TravelReadings readings, MotionType motion);

}  // namespace lightstripe
