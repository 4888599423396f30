// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A progress line on stderr: done, rate, time left. Only on a terminal, and never when quiet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "pipeline/job.h"

namespace lightstripe {

/// Draws the line, and clears it when the last copy of the callback goes. Empty where nothing is to be drawn.
ProgressCallback progress_line(bool quiet);

/// Columns of the terminal that stderr is, 80 where it does not say.
std::size_t terminal_width();

/// The text of the line; a function of its own so that it can be tested.
std::string progress_text(const JobProgress& progress, double seconds);

}  // namespace lightstripe
