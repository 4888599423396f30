// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Runs the built binary as a user would and keeps what it says.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "test_paths.h"

namespace lightstripe {

/// A folder of the test's own, removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "lightstripe test XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

inline void write_text(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

struct CommandResult {
  int exit_code = -1;
  std::string out, err;
};

inline std::string quoted(const std::filesystem::path& path) { return "'" + path.string() + "'"; }

/// Begins a line of the shell in which `lightstripe` is the program of this build.
inline const std::string kProgramOnPath =
    "PATH=" + quoted(std::filesystem::path(LIGHTSTRIPE_BINARY).parent_path()) + ":$PATH; ";

/// A line for the shell.
inline CommandResult run_shell(const std::string& line) {
  const TemporaryFolder folder;
  const std::string command = "(" + line + ") >" + quoted(folder / "out") + " 2>" + quoted(folder / "err");
  const int status = std::system(command.c_str());  // NOLINT(cert-env33-c): the shell is what is tested
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(folder / "out"), text_of(folder / "err")};
}

/// `arguments` as one would type them after `lightstripe`.
inline CommandResult run_lightstripe(const std::string& arguments) {
  return run_shell(std::string(LIGHTSTRIPE_COMMAND) + " " + arguments);
}

}  // namespace lightstripe
