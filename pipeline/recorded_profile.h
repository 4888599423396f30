// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// One section as a measuring device wrote it: MiniProf or Simpack.
#pragma once

#include <string>

#include "measure/profile_formats.h"

namespace lightstripe {

/// A section of this kind, which is also that of a file that does not say it. An Error where the file cannot
/// be read, is none of the format, or holds the other kind.
RecordedProfile read_recorded(const std::string& path, ProfileFormat format, ObjectKind kind);

}  // namespace lightstripe
