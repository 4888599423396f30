// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Rendering a scene with a progress line; used by the commands simulate and demo.
#pragma once

#include "apps/command.h"
#include "simulate/simulate.h"

namespace lightstripe {

/// Renders into common.output. `scene_file`, where the scene was read, must not be one of the files there.
SimulationSummary simulate_with_progress(const Scene& scene, const std::string& scene_file,
                                         const CommonOptions& common);

}  // namespace lightstripe
