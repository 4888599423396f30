// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/own_files.h"

#include <sstream>
#include <system_error>
#include <utility>

#include "core/error.h"
#include "io/atomic_file.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHead =
    "# written by lightstripe, which may replace and delete these files of this folder\n";

/// A marker that somebody has changed names nothing outside its folder.
bool stays_inside(const fs::path& file) {
  if (file.empty() || file.is_absolute()) return false;
  for (const fs::path& part : file)
    if (part == "..") return false;
  return true;
}

}  // namespace

OwnFiles::OwnFiles(fs::path folder, std::string marker)
    : folder_(std::move(folder)), marker_(std::move(marker)) {
  std::error_code error;
  if (!fs::is_regular_file(folder_ / marker_, error)) return;
  std::istringstream lines(read_file(folder_ / marker_));
  for (std::string line; std::getline(lines, line);)
    if (!line.empty() && line.front() != '#' && stays_inside(line)) files_.insert(line);
}

void OwnFiles::refuse_foreign(const std::set<std::string>& planned) const {
  std::error_code error;
  for (const std::string& file : planned)
    if (!has(file) && fs::exists(fs::symlink_status(folder_ / file, error)))
      throw Error((folder_ / file).string(), "is there already, and lightstripe has not written it",
                  "name an empty or new folder");
}

void OwnFiles::remove(const std::string& file) {
  std::error_code error;
  fs::remove(folder_ / file, error);
  if (!error) files_.erase(file);
}

void OwnFiles::claim(const std::set<std::string>& planned) {
  files_.insert(planned.begin(), planned.end());
  write_marker();
}

void OwnFiles::release_missing() {
  std::error_code error;
  std::erase_if(files_, [&](const std::string& file) {
    return !fs::exists(fs::symlink_status(folder_ / file, error));
  });
  if (files_.empty())
    fs::remove(folder_ / marker_, error);
  else
    write_marker();
}

void OwnFiles::write_marker() const {
  std::string text = kHead;
  for (const std::string& file : files_) text += file + "\n";
  write_file(folder_ / marker_, text);
}

}  // namespace lightstripe
