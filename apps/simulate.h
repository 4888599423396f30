// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Rendering a scene with a progress line; used by the commands simulate and demo.
#pragma once

#include "apps/command.h"
#include "simulate/simulate.h"

namespace lightstripe {

/// Renders into common.output.
SimulationSummary simulate_with_progress(const Scene& scene, const CommonOptions& common);

}  // namespace lightstripe
