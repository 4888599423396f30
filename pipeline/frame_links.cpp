// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/frame_links.h"

#include <fmt/format.h>

#include <string_view>

#include "io/raw_frames.h"
#include "io/rig_file.h"
#include "pipeline/recording.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

/// As the path of an URL; nothing is left of HTML's own characters.
std::string escaped(const std::string& path) {
  constexpr std::string_view kPlain = "-_.~/";
  std::string out;
  for (const char c : path) {
    const bool letter = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
    if (letter || kPlain.find(c) != std::string_view::npos)
      out.push_back(c);
    else
      out += fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return out;
}

/// "video.mp4#12" lies in video.mp4.
fs::path file_of(const fs::path& pattern, const std::string& picture) {
  if (pattern.filename().string().find_first_of("*?") == std::string::npos) return pattern;
  return pattern.parent_path() / picture;
}

}  // namespace

std::map<std::int64_t, std::vector<FrameLink>> frame_links(const std::string& scan_file,
                                                           const std::string& rig_file, const fs::path& page,
                                                           const std::vector<std::int64_t>& frames) {
  const Scan scan = read_scan(scan_file);
  const Rig rig = read_rig(rig_file.empty() ? scan.folder / scan.rig : fs::path(rig_file));
  const Recording recording(scan, scan_file, rig);
  const fs::path folder = fs::absolute(page).parent_path();
  const std::map<std::string, std::string> patterns(scan.frames.begin(), scan.frames.end());
  std::map<std::int64_t, std::vector<FrameLink>> out;
  for (const std::int64_t frame : frames) {
    if (frame < recording.first_frame() || frame >= recording.end_frame()) continue;
    for (std::size_t s = 0; s < rig.sensors.size(); ++s) {
      const std::string& name = rig.sensors[s].name;
      const std::string picture = recording.picture_name(frame, static_cast<int>(s));
      if (picture.empty()) continue;
      const fs::path file = fs::absolute(scan.folder / file_of(files_of_frames(patterns.at(name)), picture));
      out[frame].push_back({name, escaped(file.lexically_proximate(folder).string())});
    }
  }
  return out;
}

std::string link_to(const fs::path& file, const fs::path& page) {
  if (file.empty()) return "";
  return escaped(fs::absolute(file).lexically_proximate(fs::absolute(page).parent_path()).string());
}

}  // namespace lightstripe
