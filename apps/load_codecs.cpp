// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// opencv_codecs() of the program: loads lightstripe_codecs.so when it is first asked for.
#include <dlfcn.h>

#include <filesystem>

#include "core/error.h"
#include "io/opencv_codecs.h"

namespace lightstripe {
namespace {

/// Where the build and the installation put it: ../lib/lightstripe as seen from the program.
std::filesystem::path module_path() {
  const auto program = std::filesystem::read_symlink("/proc/self/exe");
  return program.parent_path().parent_path() / "lib" / "lightstripe" / "lightstripe_codecs.so";
}

const OpencvCodecs& load() {
  const std::filesystem::path path = module_path();
  void* const module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);  // stays loaded to the end
  if (module == nullptr)
    throw Error(path.string(), std::string("cannot be loaded: ") + dlerror(),
                "it belongs to the program, install lightstripe completely");
  using Door = const OpencvCodecs* (*)();
  const auto door = reinterpret_cast<Door>(dlsym(module, "lightstripe_opencv_codecs"));
  if (door == nullptr)
    throw Error(path.string(), "is no module of this program", "install lightstripe completely");
  return *door();
}

}  // namespace

const OpencvCodecs& opencv_codecs() {
  static const OpencvCodecs& codecs = load();
  return codecs;
}

}  // namespace lightstripe
