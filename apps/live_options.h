// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Options that `record` and `live` share.
#pragma once

#include "apps/options.h"
#include "core/error.h"
#include "pipeline/record_frames.h"

namespace lightstripe {

inline constexpr const char* kSourceHelp =
    "aravis:SERIAL?exposure_us=200&frame_rate=180 (GenICam), v4l2:/dev/video0, rtsp://..., or files played "
    "like a camera: a "
    "folder, pattern, video or TIFF, with ?frame_rate=N at that rate";

inline void add_live_options(CLI::App& command, std::int64_t& frames, double& seconds, LiveTravel& travel) {
  command.add_option("--count", frames, "stop after so many frames")->check(CLI::NonNegativeNumber);
  command.add_option("--seconds", seconds, "stop after this time")->check(CLI::NonNegativeNumber);
  const auto number = [&](const char* flag, std::optional<double>& value, const char* help) {
    command.add_option_function<double>(
        flag, [&value](double given) { value = given; }, help);
  };
  number("--mm-per-count", travel.mm_per_count,
         "travel by the encoder's count (option encoder= of the source)");
  number("--mm-per-s", travel.mm_per_s, "travel at this speed by the camera's clock");
  number("--step-mm", travel.step_mm, "travel from one frame to the next (trigger by way)");
}

inline void refuse_two_travels(const LiveTravel& travel) {
  if (travel.mm_per_count.has_value() + travel.mm_per_s.has_value() + travel.step_mm.has_value() > 1)
    throw Error("--mm-per-count, --mm-per-s, --step-mm", "more than one says how the rig travels",
                "give one of them");
}

}  // namespace lightstripe
