// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The calibration session and the scan as people write them (docs/interface.md).
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/board.h"
#include "core/rig.h"
#include "io/images.h"
#include "io/yaml_binding.h"

namespace lightstripe {

/// Pictures with the laser off, one for all or one each: sensor name and file pattern; no name: of every
/// sensor. Written as a text or as a map.
struct Backgrounds {
  std::vector<std::pair<std::string, std::string>> of_sensor;

  bool empty() const { return of_sensor.empty(); }
  /// Empty where the sensor has none.
  std::string pattern(const std::string& sensor) const;
};

struct SessionSensor {
  std::string name;
  std::string board;                 ///< file pattern, laser off (or on, if `laser` is left out)
  std::optional<std::string> laser;  ///< file pattern, same poses, laser on
  int laser_planes = 1;
  std::optional<std::string> camera{};      ///< file of known intrinsics, see read_camera_file()
  bool camera_fixed = true;                 ///< false: they are start values only
  bool no_laser = false;                    ///< `laser: none`: the boards calibrate the camera alone
  std::optional<std::string> board_only{};  ///< file pattern of further boards, without laser
  std::optional<std::string> bed{};         ///< picture of one board lying flat on the bed
  std::optional<std::string> heights{};     ///< table image,height_mm: the laser on blocks over the bed
  std::optional<std::string> background{};  ///< file pattern, laser off; else the board pictures of pairs
};

struct SessionMotion {
  MotionType type = MotionType::kLinear;
  std::string sensor;
  std::string board;   ///< file pattern
  std::string travel;  ///< travel.csv: image,travel_mm (rotary: image,angle_deg)
  Moves moves = Moves::kRig;
};

/// A calibration session; paths are relative to `folder`.
struct Session {
  std::filesystem::path folder;
  Target target;
  std::string aprilgrid_file{};  ///< Kalibr's description of the target, as the session names it
  std::vector<SessionSensor> sensors;
  std::optional<SessionMotion> motion;
  std::optional<std::string> tool_poses{};  ///< motion of type poses: its file, image,qw,qx,qy,qz,x,y,z
  Eigen::Vector3d up{0, -1, 0};             ///< hint, first sensor's camera frame
  Channel channel = Channel::kAuto;
  YamlSubtree extraction;   ///< any option of the extraction
  YamlSubtree calibration;  ///< any option of the calibration
};

Session read_session(const std::filesystem::path& path);
/// The target of a session file, or described as in one: `{type: circles, grid: [7, 7], pitch: 37.5}`; files
/// that it names are relative to `folder`.
Target read_target(const std::string& yaml_or_file, const std::filesystem::path& folder = {},
                   std::string* aprilgrid_file = nullptr);
std::string session_to_yaml(const Session& session);

enum class TravelSource { kNone, kFile, kStep, kPoses };

/// A recorded scan; paths are relative to `folder`.
struct Scan {
  std::filesystem::path folder;
  std::string rig;
  std::vector<std::pair<std::string, std::string>>
      frames;  ///< sensor name, pattern or video; in the file's order
  TravelSource travel = TravelSource::kNone;
  std::string travel_file;  ///< kFile: frame,travel_mm (rotary: frame,angle_deg)
  double travel_step = 0;   ///< kStep: mm or degrees a frame
  std::string poses_file;   ///< kPoses: frame,qw,qx,qy,qz,x,y,z
  std::string poses_of;     ///< kPoses: sensor name, or "rig"
  Channel channel = Channel::kAuto;
  Backgrounds background{};
  YamlSubtree extraction;
};

Scan read_scan(const std::filesystem::path& path);
std::string scan_to_yaml(const Scan& scan);

}  // namespace lightstripe
