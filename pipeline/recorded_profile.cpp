// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/recorded_profile.h"

#include <fmt/format.h>

#include <fstream>

#include "core/error.h"
#include "io/atomic_file.h"
#include "pipeline/measure_input.h"

namespace lightstripe {

RecordedProfile read_recorded(const std::string& path, ProfileFormat format, ObjectKind kind) {
  refuse_special_file(path);
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error(path, "cannot be read", "check the name");
  RecordedProfile profile =
      format == ProfileFormat::kMiniProf ? read_miniprof(in, path, kind) : read_simpack(in, path);
  if (profile.kind != kind)
    throw Error(path, fmt::format("is a {}, not a {}", kind_name(profile.kind), kind_name(kind)),
                fmt::format("take it as a {}, or give another file", kind_name(profile.kind)));
  return profile;
}

}  // namespace lightstripe
