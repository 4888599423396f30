// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/session_file.h"

#include <cmath>
#include <set>

#include "core/error.h"
#include "io/backgrounds_field.h"
#include "io/sensor_name.h"
#include "io/session_target.h"

namespace lightstripe {
namespace {

constexpr int kMaxLaserPlanes = 100;  // a sensor

/// The file as it is written; what is required is optional here and asked for afterwards.
struct SensorFields {
  std::optional<std::string> name, board, laser;
  std::optional<int> laser_planes;
  std::optional<std::string> camera;
  std::optional<bool> camera_fixed;
  std::optional<std::string> board_only, bed, heights, background;
};
template <class V>
void visit_fields(V&& v, SensorFields& o) {
  v("name", o.name);
  v("board", o.board);
  v("laser", o.laser);
  v("laser_planes", o.laser_planes);
  v("camera", o.camera);
  v("camera_fixed", o.camera_fixed);
  v("board_only", o.board_only);
  v("bed", o.bed);
  v("heights", o.heights);
  v("background", o.background);
}

/// How a session says what moves; `poses` become the rig's place on the tool, not a Motion.
enum class SessionMotionType { kLinear, kRotary, kPoses };
constexpr std::array<EnumName<SessionMotionType>, 3> enum_names(SessionMotionType) {
  return {{{SessionMotionType::kLinear, "linear"},
           {SessionMotionType::kRotary, "rotary"},
           {SessionMotionType::kPoses, "poses"}}};
}

struct MotionFields {
  std::optional<SessionMotionType> type;
  std::optional<std::string> sensor, board, travel, file;
  Moves moves = Moves::kRig;
};
template <class V>
void visit_fields(V&& v, MotionFields& o) {
  v("type", o.type);
  v("sensor", o.sensor);
  v("board", o.board);
  v("travel", o.travel);
  v("file", o.file);
  v("moves", o.moves);
}

struct SessionFields {
  std::optional<TargetFields> target;
  std::vector<SensorFields> sensors;
  std::optional<MotionFields> motion;
  std::optional<Eigen::Vector3d> up;
  std::optional<Channel> channel;
  std::optional<Backgrounds> background;
  std::optional<std::string> polarity;  ///< as extraction: {polarity: ...}
  YamlSubtree extraction, calibration;
};
template <class V>
void visit_fields(V&& v, SessionFields& o) {
  v("target", o.target);
  v("sensors", o.sensors);
  v("motion", o.motion);
  v("up", o.up);
  v("channel", o.channel);
  v("background", o.background);
  v("polarity", o.polarity);
  v("extraction", o.extraction);
  v("calibration", o.calibration);
}

/// Known heights need both files, and boards or a camera for the intrinsics.
void check_heights(const SensorFields& fields, const std::string& key, const Checker& check) {
  check.require(fields.bed.has_value() == fields.heights.has_value(), key + (fields.bed ? "heights" : "bed"),
                "is missing", "give bed (a picture of the board on the bed) and heights (image,height_mm)");
  if (!fields.bed) return;
  check.text(fields.bed, key + "bed");
  check.text(fields.heights, key + "heights");
  check.require(fields.board || (fields.camera && fields.camera_fixed.value_or(true)), key + "camera",
                "is missing", "give the camera's file, or board: pictures of boards to calibrate it by");
  check.require(fields.laser_planes.value_or(1) == 1, key + "laser_planes", "is not 1",
                "known heights calibrate one laser plane");
}

SessionSensor checked_sensor(const SensorFields& fields, const std::string& key, const Checker& check) {
  SessionSensor sensor;
  sensor.name = check.text(fields.name, key + "name");
  check_sensor_name(sensor.name, check.file + ": " + key + "name");
  check.require(sensor.name != "rig" && sensor.name != "tool", key + "name",
                "is a reserved name (poses may be `of: rig` or `of: tool`)", "choose another name");
  sensor.laser_planes = fields.laser_planes.value_or(1);
  check.require(sensor.laser_planes >= 1 && sensor.laser_planes <= kMaxLaserPlanes, key + "laser_planes",
                "is out of range", "give 1 to " + std::to_string(kMaxLaserPlanes));
  check_heights(fields, key, check);
  sensor.bed = fields.bed;
  sensor.heights = fields.heights;
  if (!fields.bed || fields.board) sensor.board = check.text(fields.board, key + "board");
  if (fields.laser) check.text(fields.laser, key + "laser");
  if (fields.board_only) check.text(fields.board_only, key + "board_only");
  const bool none = fields.laser == "none";
  check.require(!none || (!fields.laser_planes && !fields.board_only), key + "laser",
                "is none, so that laser_planes and board_only say nothing", "leave them out");
  sensor.no_laser = none || (fields.bed && !fields.laser);
  if (!sensor.no_laser) sensor.laser = fields.laser;
  if (none && !fields.bed) sensor.laser_planes = 0;
  sensor.board_only = fields.board_only;
  if (fields.background) sensor.background = check.text(fields.background, key + "background");
  check.require(!sensor.background || !none || fields.bed, key + "background", "says nothing without a laser",
                "leave it out");
  if (fields.camera) check.text(fields.camera, key + "camera");
  check.require(fields.camera || !fields.camera_fixed, key + "camera_fixed", "says nothing without camera",
                "give the camera's file, or leave it out");
  sensor.camera = fields.camera;
  sensor.camera_fixed = fields.camera_fixed.value_or(true);
  return sensor;
}

std::vector<SessionSensor> checked_sensors(const std::vector<SensorFields>& fields, const Checker& check) {
  check.require(!fields.empty(), "sensors", "is missing or empty",
                "list at least one sensor with name and board");
  std::vector<SessionSensor> sensors;
  std::set<std::string> names;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::string key = "sensors[" + std::to_string(i) + "].";
    sensors.push_back(checked_sensor(fields[i], key, check));
    check.require(names.insert(sensors.back().name).second, key + "name", "is the name of an earlier sensor",
                  "give each its own name");
  }
  return sensors;
}

/// A session's own `background` is that of each sensor which names none itself.
void give_backgrounds(const Backgrounds& backgrounds, std::vector<SessionSensor>& sensors,
                      const Checker& check) {
  std::vector<std::string> names;
  for (const SessionSensor& sensor : sensors) names.push_back(sensor.name);
  check_backgrounds(backgrounds, names, check.file, {"this session", "sensors", "as a key of the sensor"});
  for (SessionSensor& sensor : sensors)
    if (const std::string pattern = backgrounds.pattern(sensor.name); !sensor.background && !pattern.empty())
      sensor.background = pattern;
}

SessionMotion checked_motion(const MotionFields& fields, const std::vector<SessionSensor>& sensors,
                             const Checker& check) {
  const std::string sensor = check.text(fields.sensor, "motion.sensor");
  bool known = false;
  for (const SessionSensor& entry : sensors) known = known || entry.name == sensor;
  check.require(known, "motion.sensor", "names no sensor of this session", "use a name from sensors");
  check.require(!fields.file, "motion.file", "belongs to poses", "give board and travel, or type: poses");
  const bool rotary = *fields.type == SessionMotionType::kRotary;
  return {rotary ? MotionType::kRotary : MotionType::kLinear, sensor,
          check.text(fields.board, "motion.board"), check.text(fields.travel, "motion.travel"), fields.moves};
}

/// The file of the tool's poses.
std::string checked_tool_poses(const MotionFields& fields, const Checker& check) {
  check.require(!fields.board && !fields.travel, "motion", "of type poses has board or travel",
                "give file only: the poses belong to the sensors' board pictures");
  return check.text(fields.file, "motion.file");
}

}  // namespace

Session read_session(const std::filesystem::path& path) {
  SessionFields fields;
  read_yaml(path, fields);
  const Checker check{path.string()};
  Session session;
  session.folder = path.parent_path();
  session.target = checked_target(fields.target, session.folder, check);
  if (session.target.type == TargetType::kAprilgrid) session.aprilgrid_file = *fields.target->file;
  session.sensors = checked_sensors(fields.sensors, check);
  if (fields.background) give_backgrounds(*fields.background, session.sensors, check);
  if (fields.motion) {
    const bool poses = check.given(fields.motion->type, "motion.type") == SessionMotionType::kPoses;
    if (poses)
      session.tool_poses = checked_tool_poses(*fields.motion, check);
    else
      session.motion = checked_motion(*fields.motion, session.sensors, check);
  }
  if (fields.up) session.up = *fields.up;
  check.require(session.up.norm() > 1e-9, "up", "is a zero vector",
                "point it up in the first sensor's camera frame");
  if (fields.channel) session.channel = *fields.channel;
  session.extraction = extraction_part(fields.extraction, fields.polarity, path);
  session.calibration = fields.calibration;
  return session;
}

std::string session_to_yaml(const Session& session) {
  SessionFields fields;
  const Target& target = session.target;
  fields.target = target_fields(target, session.aprilgrid_file);
  for (const SessionSensor& sensor : session.sensors) {
    SensorFields entry;
    entry.name = sensor.name;
    if (!sensor.board.empty()) entry.board = sensor.board;
    entry.laser = sensor.laser;
    if (sensor.no_laser) entry.laser = "none";
    entry.camera = sensor.camera;
    entry.board_only = sensor.board_only;
    entry.bed = sensor.bed;
    entry.heights = sensor.heights;
    entry.background = sensor.background;
    fields.sensors.push_back(std::move(entry));
    if (!sensor.camera_fixed) fields.sensors.back().camera_fixed = false;
    if (sensor.laser_planes > 1) fields.sensors.back().laser_planes = sensor.laser_planes;
  }
  if (session.motion) {
    const SessionMotion& motion = *session.motion;
    fields.motion = MotionFields{
        motion.type == MotionType::kRotary ? SessionMotionType::kRotary : SessionMotionType::kLinear,
        motion.sensor,
        motion.board,
        motion.travel,
        std::nullopt,
        motion.moves};
  }
  if (session.tool_poses) {
    fields.motion.emplace();
    fields.motion->type = SessionMotionType::kPoses;
    fields.motion->file = session.tool_poses;
  }
  fields.up = session.up;
  if (session.channel != Channel::kAuto) fields.channel = session.channel;
  fields.extraction = session.extraction;
  fields.calibration = session.calibration;
  return dump_yaml(fields);
}

Target read_target(const std::string& yaml_or_file, const std::filesystem::path& folder,
                   std::string* aprilgrid_file) {
  if (!yaml_or_file.starts_with("{")) {
    const Session session = read_session(yaml_or_file);
    if (aprilgrid_file) *aprilgrid_file = session.aprilgrid_file;
    return session.target;
  }
  TargetFields fields;
  const detail::YamlPlace place{"--target", ""};
  detail::read_field(detail::parse_yaml(yaml_or_file, place), fields, place);
  if (aprilgrid_file) *aprilgrid_file = fields.file.value_or("");
  return checked_target(fields, folder, Checker{"--target"});
}

}  // namespace lightstripe
