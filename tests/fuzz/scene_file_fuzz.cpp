// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A scene that passes its checks can be dumped and read again.

#include "core/error.h"
#include "fuzz_input.h"
#include "io/yaml_binding.h"
#include "simulate/scene.h"

namespace lightstripe::fuzz {

const std::string_view kExtension = ".yaml";

void read_input(const std::filesystem::path& file) {
  const Scene scene = read_scene(file);
  LIGHTSTRIPE_CHECK(!dump_yaml(scene).empty(), "a scene has a text");
}

}  // namespace lightstripe::fuzz
