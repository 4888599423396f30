// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Cameras of other tools.

#include "core/error.h"
#include "fuzz_input.h"
#include "io/camera_file.h"

namespace lightstripe::fuzz {

const std::string_view kExtension = ".yaml";

void read_input(const std::filesystem::path& file) {
  const Camera camera = read_camera_file(file.string());
  LIGHTSTRIPE_CHECK(camera.fx > 0 && camera.fy > 0, "a camera has focal lengths");
}

}  // namespace lightstripe::fuzz
