// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// One frame with both rails of a track -> one row: the left rail in the table's own columns, the right one
// and the gauge behind them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "measure/measure_profile.h"
#include "measure/track_conicity.h"

namespace lightstripe {

struct MeasuredTrack {
  const ReferenceShape& left;                   ///< the rail at +u
  const ReferenceShape& right;                  ///< may be the same
  double between_u = 0;                         ///< where the rails part, see place_between_rails()
  std::optional<double> rig_sigma_mm = {};      ///< of each rail's place, from the rig's calibration
  const ReferenceWheelset* wheelset = nullptr;  ///< for the conicity; nullptr: not asked for
};

/// The gauge side of each rail is the one that faces the other. `status` is ok where both rails and the gauge
/// are. The conicity asks for no status: where the wheels' contact leaves the head its cell is empty.
MeasuredFrame measure_track(const Profile& profile, const MeasuredTrack& track,
                            const MeasureOptions& options);

/// Behind `status`: the left rail's extras, gauge, and all of the right rail's with the prefix right_; with a
/// wheelset conicity (at 3 mm) and conicity_nonlinearity.
std::vector<std::string> track_extra_names(bool with_conicity = false);

}  // namespace lightstripe
