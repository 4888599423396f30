// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/overlay_files.h"

#include <fmt/format.h>

#include <map>
#include <set>

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

/// A name that is not in `taken` yet; it is then.
fs::path free_name(const fs::path& image, std::set<std::string>& taken) {
  std::string name = image.stem().string();
  if (taken.contains(name)) name = image.parent_path().filename().string() + "_" + name;
  for (int copy = 2; taken.contains(name); ++copy) name = fmt::format("{}_{}", image.stem().string(), copy);
  taken.insert(name);
  return name + ".png";
}

}  // namespace

std::vector<fs::path> overlay_files(const std::vector<std::string>& images, const fs::path& folder) {
  std::vector<fs::path> files;
  std::set<std::string> taken;
  for (const std::string& image : images) files.push_back(folder / free_name(image, taken));
  return files;
}

std::vector<fs::path> board_overlay_files(const std::vector<std::pair<std::string, fs::path>>& boards,
                                          const fs::path& folder) {
  std::vector<fs::path> files;
  std::map<std::string, std::set<std::string>> taken;
  for (const auto& [sensor, board] : boards)
    files.push_back(folder / sensor / free_name(board, taken[sensor]));
  return files;
}

}  // namespace lightstripe
