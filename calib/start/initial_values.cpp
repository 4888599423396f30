// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/start/initial_values.h"

#include <utility>

#include "calib/start/correct_circles.h"

namespace lightstripe {

InitialValues initial_values(SessionViews session) {
  InitialValues values;
  values.session = std::move(session);
  values.warnings = values.session.left_out;
  start_cameras(values);
  if (values.session.target.has_circles()) {
    correct_circles(values);
    values.state.sensors.clear();
    start_cameras(values);
  }
  link_sensors(values);
  start_laser_planes(values);
  if (values.session.motion != MotionType::kNone) start_motion(values);
  return values;
}

void keep_views(InitialValues& values, const std::vector<bool>& keep) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (!keep[i]) continue;
    if (kept != i) {
      values.session.views[kept] = std::move(values.session.views[i]);
      values.cam_from_board[kept] = values.cam_from_board[i];
    }
    ++kept;
  }
  values.session.views.resize(kept);
  values.cam_from_board.resize(kept);
}

}  // namespace lightstripe
