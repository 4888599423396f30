// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// libFuzzer's entry point, shared by all targets; replay.cpp calls it where there is no libFuzzer.
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <opencv2/core/utils/logger.hpp>
#include <string>

#include "core/error.h"
#include "fuzz_input.h"

namespace {

namespace fs = std::filesystem;

/// One file of this process, in memory where the system has such a folder; its name does not depend on the
/// input.
const fs::path& input_file() {
  static const struct Owner {
    fs::path path;
    Owner() {
      std::error_code error;
      const fs::path folder =
          fs::is_directory("/dev/shm", error) ? fs::path("/dev/shm") : fs::temp_directory_path();
      path = folder /
             ("lightstripe-fuzz-" + std::to_string(::getpid()) + std::string(lightstripe::fuzz::kExtension));
      cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    }
    ~Owner() {
      std::error_code ignored;
      fs::remove(path, ignored);
    }
    Owner(const Owner&) = delete;
    Owner& operator=(const Owner&) = delete;
  } owner;
  return owner.path;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::ofstream(input_file(), std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    lightstripe::fuzz::read_input(input_file());
  } catch (const lightstripe::Error&) {  // said what is wrong: as it should be
  }
  return 0;
}
