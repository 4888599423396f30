// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What the README and the pages under docs/ show, to be run and compared.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "command_line.h"
#include "io/images.h"
#include "test_paths.h"

namespace lightstripe {

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::stringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// The lines of the blocks ```language, without indent.
inline std::vector<std::string> block_lines(const std::string& markdown, const std::string& language) {
  std::vector<std::string> found;
  bool inside = false;
  for (std::string line : lines_of(markdown)) {
    line.erase(0, line.find_first_not_of(' '));
    if (line.starts_with("```")) {
      inside = line == "```" + language;
    } else if (inside && !line.empty()) {
      found.push_back(line);
    }
  }
  return found;
}

/// The commands of the sh blocks, without comments.
inline std::vector<std::string> commands_of(const std::string& markdown) {
  std::vector<std::string> commands;
  for (const std::string& line : block_lines(markdown, "sh")) {
    const std::string command = line.substr(0, line.find(" #"));
    commands.push_back(command.substr(0, command.find_last_not_of(' ') + 1));
  }
  return commands;
}

/// Every relative link of a page leads to a file.
inline void expect_links_lead_to_files(const std::filesystem::path& page) {
  const std::string text = text_of(page);
  const std::regex link(R"(\]\(([^)]+)\))");
  for (std::sregex_iterator it(text.begin(), text.end(), link), end; it != end; ++it)
    EXPECT_TRUE(std::filesystem::exists(page.parent_path() / (*it)[1].str())) << page << ": " << (*it)[1];
}

/// A folder in which the pages' commands find what they name: session.yaml, scan.yaml, frame.png, scene.yaml,
/// configs, build/bin/lightstripe.
inline void prepare_own_rig(const TemporaryFolder& folder) {
  namespace fs = std::filesystem;
  ASSERT_EQ(run_lightstripe("simulate testdata/one_sensor.yaml -o " + quoted(folder.path())).exit_code, 0);
  fs::rename(folder / "calibration.yaml", folder / "session.yaml");
  fs::copy(folder / "scan/solo/0002.png", folder / "frame.png");
  Image8 off = read_image(folder / "frame.png");
  std::fill(off.pixels.begin(), off.pixels.end(), std::uint8_t{5});  // a dark room
  write_image(folder / "off.png", off.view());
  fs::copy(LIGHTSTRIPE_SOURCE_DIR "/testdata/one_sensor.yaml", folder / "scene.yaml");
  fs::copy(LIGHTSTRIPE_SOURCE_DIR "/configs", folder / "configs", fs::copy_options::recursive);
  // The same stretch in a fifth of the frames: what the pages' commands do with it is the same.
  std::string scene = text_of(folder / "configs/scenes/first_rig.yaml");
  const std::string scan = "scan: {frames: 110, step_mm: 1}";
  ASSERT_NE(scene.find(scan), std::string::npos);
  scene.replace(scene.find(scan), scan.size(), "scan: {frames: 22, step_mm: 5}");
  write_text(folder / "configs/scenes/first_rig.yaml", scene);
  fs::create_directories(folder / "build/bin");
  fs::create_symlink(LIGHTSTRIPE_BINARY, folder / "build/bin/lightstripe");
}

/// Runs the page's commands in the folder, but for those that fetch, build or install. Where a command copies
/// examples, the files of this folder take their place again, as if the user had filled them in.
inline void expect_commands_run(const std::filesystem::path& page, const TemporaryFolder& folder) {
  const std::string session = text_of(folder / "session.yaml"), scan = text_of(folder / "scan.yaml");
  for (const auto& command : commands_of(text_of(page))) {
    if (command.starts_with("scripts/") || command.starts_with("cmake --install") ||
        command.starts_with("git clone"))
      continue;
    EXPECT_EQ(std::system(("cd " + quoted(folder.path()) + " && " + command).c_str()), 0)
        << page << ": " << command;
    if (!command.starts_with("cp configs/")) continue;
    write_text(folder / "session.yaml", session);
    write_text(folder / "scan.yaml", scan);
  }
}

}  // namespace lightstripe
