// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/recorded_profile.h"

#include <fstream>

#include "core/error.h"
#include "io/atomic_file.h"

namespace lightstripe {

RecordedProfile read_recorded(const std::string& path, ProfileFormat format, ObjectKind kind) {
  refuse_special_file(path);
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error(path, "cannot be read", "check the name");
  return format == ProfileFormat::kMiniProf ? read_miniprof(in, path, kind) : read_simpack(in, path);
}

}  // namespace lightstripe
