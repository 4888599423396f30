// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// One section as a measuring device wrote it: MiniProf or Simpack.
#pragma once

#include <string>

#include "measure/profile_formats.h"

namespace lightstripe {

/// `kind`: of a file that does not say it. An Error where the file cannot be read, or is none of the format.
RecordedProfile read_recorded(const std::string& path, ProfileFormat format, ObjectKind kind);

}  // namespace lightstripe
