// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Equivalent conicity in sentences.
#pragma once

#include <filesystem>

#include "measure/conicity.h"
#include "report/message.h"

namespace lightstripe {

/// `table`: where the amplitudes are written.
Messages describe_conicity(const Conicity& conicity, const std::filesystem::path& table);

}  // namespace lightstripe
