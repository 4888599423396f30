// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/output_guard.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>

#include "core/error.h"
#include "io/images.h"
#include "io/raw_frames.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

/// What makes two names the same file.
using Identity = std::variant<std::pair<dev_t, ino_t>, std::string>;

/// Nothing for devices, pipes and folders.
std::optional<Identity> identity_of(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0) {
    if (!S_ISREG(status.st_mode)) return std::nullopt;
    return std::pair(status.st_dev, status.st_ino);
  }
  std::error_code error;
  const fs::path resolved = fs::weakly_canonical(fs::absolute(path, error), error);
  return error ? path.string() : resolved.string();
}

/// Which inputs may be one of the outputs: any where an output exists already, else only one of the same
/// name, which does not exist either.
class InputsToCompare {
 public:
  explicit InputsToCompare(const std::vector<fs::path>& outputs) : exists_(any_exists(outputs)) {
    for (const fs::path& output : outputs)
      if (!output.empty()) names_.insert(output.filename().string());
  }
  bool operator()(const fs::path& input) const {
    return exists_ || names_.contains(input.filename().string());
  }

 private:
  bool exists_;
  std::set<std::string> names_;
};

void add_pattern(const fs::path& folder, const std::string& pattern, std::vector<fs::path>& files) {
  if (pattern.empty()) return;
  try {
    const auto found = list_files(folder, pattern);
    files.insert(files.end(), found.begin(), found.end());
  } catch (const Error&) {
    return;  // told when it is read
  }
}

/// Sessions, scans, features and limits are written by people: a YAML file that does not begin as this
/// program begins its own (rigs, run records, cameras) is such a one.
bool is_hand_written(const fs::path& path) {
  constexpr std::size_t kLooked = 4096;
  constexpr std::array<std::string_view, 5> kOwn{"format:", "lightstripe:", "%YAML",
                                                 "image_width:", "# Made by"};
  std::string end = path.extension().string();
  std::error_code none;
  if ((end != ".yaml" && end != ".yml") || !fs::is_regular_file(path, none)) return false;
  std::string head(kLooked, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  if (head.empty()) return false;
  return std::none_of(kOwn.begin(), kOwn.end(), [&](std::string_view begin) {
    return head.starts_with(begin) || head.find("\n" + std::string(begin)) != std::string::npos;
  });
}

}  // namespace

bool any_exists(const std::vector<fs::path>& outputs) {
  std::error_code none;
  return std::any_of(outputs.begin(), outputs.end(), [&](const fs::path& output) {
    return !output.empty() && fs::exists(fs::symlink_status(output, none));
  });
}

void guard_marked_outputs(const std::vector<fs::path>& inputs, const std::vector<fs::path>& outputs) {
  std::map<Identity, fs::path> read, written;
  const InputsToCompare may_be_one(outputs);
  for (const fs::path& input : inputs)
    if (!input.empty() && may_be_one(input))
      if (const auto identity = identity_of(input)) read.emplace(*identity, input);
  for (const fs::path& output : outputs) {
    if (output.empty()) continue;
    const auto identity = identity_of(output);
    if (!identity) continue;
    if (const auto found = read.find(*identity); found != read.end())
      throw Error(output.string(),
                  fmt::format("would be written over, but is one of the inputs ({})", found->second.string()),
                  "name another output");
    if (const auto [found, is_new] = written.emplace(*identity, output); !is_new)
      throw Error(output.string(), fmt::format("is another output as well ({})", found->second.string()),
                  "give every output a name of its own");
  }
}

void guard_outputs(const std::vector<fs::path>& inputs, const std::vector<fs::path>& outputs) {
  guard_marked_outputs(inputs, outputs);
  for (const fs::path& output : outputs)
    if (is_hand_written(output))
      throw Error(output.string(), "is a YAML file that lightstripe did not write, and would be lost",
                  "name another output, or delete it first");
}

std::vector<fs::path> files_of(const Session& session) {
  std::vector<fs::path> files;
  for (const SessionSensor& sensor : session.sensors) {
    add_pattern(session.folder, sensor.board, files);
    add_pattern(session.folder, sensor.laser.value_or(""), files);
    add_pattern(session.folder, sensor.board_only.value_or(""), files);
    add_pattern(session.folder, sensor.background.value_or(""), files);
    for (const auto& file : {sensor.bed, sensor.heights})
      if (file) files.push_back(session.folder / *file);
    if (sensor.camera) files.push_back(session.folder / sensor.camera->substr(0, sensor.camera->rfind('#')));
  }
  if (session.motion) {
    add_pattern(session.folder, session.motion->board, files);
    files.push_back(session.folder / session.motion->travel);
  }
  if (session.tool_poses) files.push_back(session.folder / *session.tool_poses);
  if (!session.aprilgrid_file.empty()) files.push_back(session.folder / session.aprilgrid_file);
  return files;
}

std::vector<fs::path> tables_of(const Scan& scan) {
  std::vector<fs::path> files{scan.folder / scan.rig};
  if (!scan.travel_file.empty()) files.push_back(scan.folder / scan.travel_file);
  if (!scan.poses_file.empty()) files.push_back(scan.folder / scan.poses_file);
  return files;
}

std::vector<fs::path> pictures_of(const Scan& scan) {
  std::vector<fs::path> files;
  for (const auto& [sensor, pattern] : scan.frames) add_pattern(scan.folder, files_of_frames(pattern), files);
  for (const auto& [sensor, pattern] : scan.background.of_sensor) add_pattern(scan.folder, pattern, files);
  return files;
}

std::vector<fs::path> files_of(const Scan& scan) {
  std::vector<fs::path> files = tables_of(scan), pictures = pictures_of(scan);
  files.insert(files.end(), pictures.begin(), pictures.end());
  return files;
}

}  // namespace lightstripe
