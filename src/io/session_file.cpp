// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/session_file.h"

#include <cmath>
#include <set>

#include "core/error.h"
#include "io/moving_part.h"
#include "io/output_guard.h"

namespace lightstripe {
namespace {

constexpr int kMaxCorners = 1000;     // a side
constexpr int kMaxLaserPlanes = 100;  // a sensor

/// `square: 10.0` or `square: [10.0, 10.1]`, mm.
struct SquareSize {
  double x = 0, y = 0;
};

void read_field(const detail::YamlNode& node, SquareSize& size, const detail::YamlPlace& place) {
  std::array<double, 2> sides{};
  if (node.kind == detail::YamlNode::Kind::kSequence) {
    detail::read_field(node, sides, place);
  } else {
    detail::read_field(node, sides[0], place);
    sides[1] = sides[0];
  }
  size = {sides[0], sides[1]};
}

void write_field(detail::YamlNode& node, const SquareSize& size) {
  if (size.x == size.y) {
    detail::write_field(node, size.x);
  } else {
    detail::write_field(node, std::array<double, 2>{size.x, size.y});
  }
}

/// The file as it is written; what is required is optional here and asked for afterwards.
struct TargetFields {
  TargetType type = TargetType::kCheckerboard;
  std::optional<std::array<int, 2>> inner_corners;
  std::optional<SquareSize> square;
  std::optional<double> marker;
  std::optional<std::string> dictionary;
};
template <class V>
void visit_fields(V&& v, TargetFields& o) {
  v("type", o.type);
  v("inner_corners", o.inner_corners);
  v("square", o.square);
  v("marker", o.marker);
  v("dictionary", o.dictionary);
}

struct SensorFields {
  std::optional<std::string> name, board, laser;
  std::optional<int> laser_planes;
  std::optional<std::string> camera;
  std::optional<bool> camera_fixed;
};
template <class V>
void visit_fields(V&& v, SensorFields& o) {
  v("name", o.name);
  v("board", o.board);
  v("laser", o.laser);
  v("laser_planes", o.laser_planes);
  v("camera", o.camera);
  v("camera_fixed", o.camera_fixed);
}

struct MotionFields {
  std::optional<MotionType> type;
  std::optional<std::string> sensor, board, travel;
  MovingPart moves = MovingPart::kRig;
};
template <class V>
void visit_fields(V&& v, MotionFields& o) {
  v("type", o.type);
  v("sensor", o.sensor);
  v("board", o.board);
  v("travel", o.travel);
  v("moves", o.moves);
}

struct SessionFields {
  std::optional<TargetFields> target;
  std::vector<SensorFields> sensors;
  std::optional<MotionFields> motion;
  std::optional<Eigen::Vector3d> up;
  std::optional<Channel> channel;
  YamlSubtree extraction, calibration;
};
template <class V>
void visit_fields(V&& v, SessionFields& o) {
  v("target", o.target);
  v("sensors", o.sensors);
  v("motion", o.motion);
  v("up", o.up);
  v("channel", o.channel);
  v("extraction", o.extraction);
  v("calibration", o.calibration);
}

/// Complaints about what was read, by file and key.
struct Checker {
  std::string file;

  void require(bool holds, const std::string& key, const char* what_is_wrong,
               const std::string& what_to_do) const {
    if (!holds) throw Error(file + ": " + key, what_is_wrong, what_to_do);
  }
  template <class T>
  T given(const std::optional<T>& value, const std::string& key, const std::string& example = "") const {
    require(value.has_value(), key, "is missing", example.empty() ? "give it" : "give it, e.g. " + example);
    return *value;
  }
  std::string text(const std::optional<std::string>& value, const std::string& key) const {
    require(!given(value, key).empty(), key, "is empty", "give a text");
    return *value;
  }
};

Target checked_target(const std::optional<TargetFields>& fields, const Checker& check) {
  const TargetFields given =
      check.given(fields, "target", "target: {type: checkerboard, inner_corners: [11, 8], square: 10.0}");
  const auto [columns, rows] = check.given(given.inner_corners, "target.inner_corners",
                                           "inner_corners: [11, 8] for a board of 12 x 9 squares");
  for (const int corners : {columns, rows}) {
    check.require(
        corners >= 2 && corners <= kMaxCorners, "target.inner_corners", "is out of range",
        "count the corners between the squares along each side, 2 to " + std::to_string(kMaxCorners));
  }
  const SquareSize square = check.given(given.square, "target.square", "square: 10.0 for 10 mm");
  check.require(square.x > 0 && square.y > 0, "target.square", "is not positive",
                "give the side of a square in mm");
  Target target{given.type, columns, rows, square.x, square.y};
  if (given.type == TargetType::kCheckerboard) {
    check.require(!given.marker && !given.dictionary, "target",
                  "has marker or dictionary, which a checkerboard has not",
                  "say type: charuco, or leave them out");
    return target;
  }
  target.marker_mm = check.given(given.marker, "target.marker");
  check.require(target.marker_mm > 0 && target.marker_mm < std::min(square.x, square.y), "target.marker",
                "is no side of a marker within a square", "give it in mm, smaller than square");
  if (given.dictionary) target.dictionary = *given.dictionary;
  return target;
}

std::vector<SessionSensor> checked_sensors(const std::vector<SensorFields>& fields, const Checker& check) {
  check.require(!fields.empty(), "sensors", "is missing or empty",
                "list at least one sensor with name and board");
  std::vector<SessionSensor> sensors;
  std::set<std::string> names;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::string key = "sensors[" + std::to_string(i) + "].";
    const std::string name = check.text(fields[i].name, key + "name");
    check_sensor_name(name, check.file + ": " + key + "name");
    check.require(name != "rig", key + "name", "is a reserved name (poses may be `of: rig`)",
                  "choose another name");
    check.require(names.insert(name).second, key + "name", "is the name of an earlier sensor",
                  "give each its own name");
    const int planes = fields[i].laser_planes.value_or(1);
    check.require(planes >= 1 && planes <= kMaxLaserPlanes, key + "laser_planes", "is out of range",
                  "give 1 to " + std::to_string(kMaxLaserPlanes));
    if (fields[i].laser) check.text(fields[i].laser, key + "laser");
    if (fields[i].camera) check.text(fields[i].camera, key + "camera");
    check.require(fields[i].camera || !fields[i].camera_fixed, key + "camera_fixed",
                  "says nothing without camera", "give the camera's file, or leave it out");
    sensors.push_back({name, check.text(fields[i].board, key + "board"), fields[i].laser, planes,
                       fields[i].camera, fields[i].camera_fixed.value_or(true)});
  }
  return sensors;
}

SessionMotion checked_motion(const MotionFields& fields, const std::vector<SessionSensor>& sensors,
                             const Checker& check) {
  const std::string sensor = check.text(fields.sensor, "motion.sensor");
  bool known = false;
  for (const SessionSensor& entry : sensors) known = known || entry.name == sensor;
  check.require(known, "motion.sensor", "names no sensor of this session", "use a name from sensors");
  return {check.given(fields.type, "motion.type"), sensor, check.text(fields.board, "motion.board"),
          check.text(fields.travel, "motion.travel"), fields.moves == MovingPart::kRig};
}

}  // namespace

Session read_session(const std::filesystem::path& path) {
  SessionFields fields;
  read_yaml(path, fields);
  const Checker check{path.string()};
  Session session;
  session.folder = path.parent_path();
  session.target = checked_target(fields.target, check);
  session.sensors = checked_sensors(fields.sensors, check);
  if (fields.motion) session.motion = checked_motion(*fields.motion, session.sensors, check);
  if (fields.up) session.up = *fields.up;
  check.require(session.up.norm() > 1e-9, "up", "is a zero vector",
                "point it up in the first sensor's camera frame");
  if (fields.channel) session.channel = *fields.channel;
  session.extraction = fields.extraction;
  session.calibration = fields.calibration;
  return session;
}

std::string session_to_yaml(const Session& session) {
  SessionFields fields;
  const Target& target = session.target;
  fields.target = TargetFields{target.type, std::array<int, 2>{target.columns, target.rows},
                               SquareSize{target.pitch_x, target.pitch_y}, std::nullopt, std::nullopt};
  if (target.type == TargetType::kCharuco) {
    fields.target->marker = target.marker_mm;
    fields.target->dictionary = target.dictionary;
  }
  for (const SessionSensor& sensor : session.sensors) {
    fields.sensors.push_back(
        {sensor.name, sensor.board, sensor.laser, std::nullopt, sensor.camera, std::nullopt});
    if (!sensor.camera_fixed) fields.sensors.back().camera_fixed = false;
    if (sensor.laser_planes != 1) fields.sensors.back().laser_planes = sensor.laser_planes;
  }
  if (session.motion) {
    const SessionMotion& motion = *session.motion;
    fields.motion =
        MotionFields{motion.type, motion.sensor, motion.board, motion.travel, moving_part(motion.rig_moves)};
  }
  fields.up = session.up;
  if (session.channel != Channel::kAuto) fields.channel = session.channel;
  fields.extraction = session.extraction;
  fields.calibration = session.calibration;
  return dump_yaml(fields);
}

}  // namespace lightstripe
