// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Tells PCL about CloudPoint. Only .cpp files of this folder (and tests) include this: PCL stays at its edge.
#pragma once

#include <pcl/point_types.h>

#include <cstdint>

#include "reconstruct/cloud.h"

// clang-format off
POINT_CLOUD_REGISTER_POINT_STRUCT(lightstripe::CloudPoint,
    (float, x, x)(float, y, y)(float, z, z)(float, intensity, intensity)
    (std::int32_t, frame, frame)(std::int32_t, sensor, sensor)(std::int32_t, line, line)(float, sigma, sigma))
// clang-format on
