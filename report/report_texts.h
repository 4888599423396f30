// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The parts of calibration.html that are built into the program, so that the file opens offline.
#pragma once

#include <string_view>

namespace lightstripe {

std::string_view report_page();     ///< apps/report/calibration.html
std::string_view report_script();   ///< apps/report/calibration.js
std::string_view chart_library();   ///< Chart.js (MIT), Debian's libjs-chart.js
std::string_view three_library();   ///< three.js (MIT), Debian's libjs-three
std::string_view orbit_controls();  ///< three.js' OrbitControls

}  // namespace lightstripe
