// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The parts of the HTML pages that are built into the program, so that the pages open offline.
#pragma once

#include <string_view>

namespace lightstripe {

/// A file of report/pages/, or one of the libraries chart.js (MIT, Debian's libjs-chart.js), three.js and
/// OrbitControls.js (MIT, Debian's libjs-three). The name must be one of them.
std::string_view page_text(std::string_view name);

}  // namespace lightstripe
