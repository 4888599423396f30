// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/session_file.h"

#include <cmath>
#include <set>

#include "core/error.h"
#include "io/moving_part.h"

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
  std::optional<std::array<int, 2>> grid;
  std::optional<double> pitch, diameter;
  std::optional<std::string> file;
  std::optional<double> rim_mm;
};
template <class V>
void visit_fields(V&& v, TargetFields& o) {
  v("type", o.type);
  v("inner_corners", o.inner_corners);
  v("square", o.square);
  v("marker", o.marker);
  v("dictionary", o.dictionary);
  v("grid", o.grid);
  v("pitch", o.pitch);
  v("diameter", o.diameter);
  v("file", o.file);
  v("rim_mm", o.rim_mm);
}

/// Kalibr's description of an AprilGrid; its lengths are metres.
struct AprilgridFields {
  std::optional<std::string> target_type;
  std::optional<int> tagCols, tagRows;
  std::optional<double> tagSize, tagSpacing;
  std::optional<int> codeOffset;
};
template <class V>
void visit_fields(V&& v, AprilgridFields& o) {
  v("target_type", o.target_type);
  v("tagCols", o.tagCols);
  v("tagRows", o.tagRows);
  v("tagSize", o.tagSize);
  v("tagSpacing", o.tagSpacing);
  v("codeOffset", o.codeOffset);
}

struct SensorFields {
  std::optional<std::string> name, board, laser;
  std::optional<int> laser_planes;
  std::optional<std::string> camera;
  std::optional<bool> camera_fixed;
  std::optional<std::string> board_only;
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

/// Corners or circles along one side.
void check_count(int count, const std::string& key, const std::string& what, const Checker& check) {
  check.require(count >= 2 && count <= kMaxCorners, key, "is out of range",
                "count the " + what + " along each side, 2 to " + std::to_string(kMaxCorners));
}

/// Checkerboard and ChArUco.
Target target_of_squares(const TargetFields& given, const Checker& check) {
  const auto [columns, rows] = check.given(given.inner_corners, "target.inner_corners",
                                           "inner_corners: [11, 8] for a board of 12 x 9 squares");
  for (const int corners : {columns, rows})
    check_count(corners, "target.inner_corners", "corners between the squares", check);
  const SquareSize square = check.given(given.square, "target.square", "square: 10.0 for 10 mm");
  check.require(square.x > 0 && square.y > 0, "target.square", "is not positive",
                "give the side of a square in mm");
  check.require(!given.grid && !given.pitch && !given.diameter && !given.file, "target",
                "has grid, pitch, diameter or file, which a board of squares has not", "leave them out");
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

Target target_of_circles(const TargetFields& given, const Checker& check) {
  check.require(!given.inner_corners && !given.square && !given.marker && !given.dictionary && !given.file,
                "target", "has keys of another type of board", "circles have grid, pitch and diameter");
  const auto [columns, rows] =
      check.given(given.grid, "target.grid", "grid: [7, 7] for 7 x 7 circles (asymmetric: [4, 11])");
  for (const int circles : {columns, rows}) check_count(circles, "target.grid", "circles", check);
  check.require(columns >= 3 && rows >= 3, "target.grid", "is too small", "3 x 3 circles at least");
  const double pitch = check.given(given.pitch, "target.pitch", "pitch: 37.5, as OpenCV's squareSize, mm");
  check.require(pitch > 0, "target.pitch", "is not positive", "give the circles' distance in mm");
  Target target{given.type, columns, rows, pitch, pitch};
  if (!given.diameter) return target;
  const double neighbours = given.type == TargetType::kCircles ? pitch : pitch * std::sqrt(2.0);
  check.require(*given.diameter > 0 && *given.diameter < neighbours, "target.diameter",
                "is no diameter of circles that stand apart", "give it in mm, or leave it out");
  target.circle_mm = *given.diameter;
  return target;
}

Target target_of_tags(const TargetFields& given, const std::filesystem::path& folder, const Checker& check) {
  check.require(!given.inner_corners && !given.square && !given.marker && !given.dictionary && !given.grid &&
                    !given.pitch && !given.diameter,
                "target", "has keys of another type of board", "an aprilgrid has file, Kalibr's own");
  const auto path = folder / check.text(given.file, "target.file");
  AprilgridFields tags;
  read_yaml(path, tags);
  const Checker inside{path.string()};
  inside.require(!tags.target_type || *tags.target_type == "aprilgrid", "target_type", "is not aprilgrid",
                 "give the file of an AprilGrid");
  const int columns = inside.given(tags.tagCols, "tagCols"), rows = inside.given(tags.tagRows, "tagRows");
  for (const int count : {columns, rows})
    inside.require(count >= 2 && count <= 30, "tagCols, tagRows", "are out of range", "2 to 30");
  const double size = inside.given(tags.tagSize, "tagSize"),
               gap = inside.given(tags.tagSpacing, "tagSpacing");
  inside.require(size > 0 && size < 1, "tagSize", "is no side of a tag in metres (Kalibr's unit)",
                 "give e.g. 0.088 for 88 mm");
  inside.require(gap > 0 && gap < 2, "tagSpacing", "is no share of the tag's side", "give e.g. 0.3");
  inside.require(tags.codeOffset.value_or(0) == 0, "codeOffset", "is not 0", "print the board from tag 0 on");
  Target target{TargetType::kAprilgrid, 2 * columns, 2 * rows};
  target.marker_mm = 1000 * size;
  target.tag_gap_mm = gap * target.marker_mm;
  target.pitch_x = target.pitch_y = 0.5 * (target.marker_mm + target.tag_gap_mm);
  return target;
}

Target checked_target(const std::optional<TargetFields>& fields, const std::filesystem::path& folder,
                      const Checker& check) {
  const TargetFields given =
      check.given(fields, "target", "target: {type: checkerboard, inner_corners: [11, 8], square: 10.0}");
  const bool circles = given.type == TargetType::kCircles || given.type == TargetType::kAsymmetricCircles;
  Target target = circles                                ? target_of_circles(given, check)
                  : given.type == TargetType::kAprilgrid ? target_of_tags(given, folder, check)
                                                         : target_of_squares(given, check);
  if (!given.rim_mm) return target;
  check.require(*given.rim_mm >= 0, "target.rim_mm", "is negative", "give the width of the plain rim in mm");
  target.rim_mm = *given.rim_mm;
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
    check.require(name != "rig", key + "name", "is a reserved name (poses may be `of: rig`)",
                  "choose another name");
    check.require(names.insert(name).second, key + "name", "is the name of an earlier sensor",
                  "give each its own name");
    const int planes = fields[i].laser_planes.value_or(1);
    check.require(planes >= 1 && planes <= kMaxLaserPlanes, key + "laser_planes", "is out of range",
                  "give 1 to " + std::to_string(kMaxLaserPlanes));
    if (fields[i].laser) check.text(fields[i].laser, key + "laser");
    if (fields[i].board_only) check.text(fields[i].board_only, key + "board_only");
    const bool no_laser = fields[i].laser == "none";
    check.require(!no_laser || (!fields[i].laser_planes && !fields[i].board_only), key + "laser",
                  "is none, so that laser_planes and board_only say nothing", "leave them out");
    if (fields[i].camera) check.text(fields[i].camera, key + "camera");
    check.require(fields[i].camera || !fields[i].camera_fixed, key + "camera_fixed",
                  "says nothing without camera", "give the camera's file, or leave it out");
    sensors.push_back({name, check.text(fields[i].board, key + "board"), fields[i].laser,
                       no_laser ? 0 : planes, fields[i].camera, fields[i].camera_fixed.value_or(true),
                       no_laser, fields[i].board_only});
    if (no_laser) sensors.back().laser.reset();
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

TargetFields target_fields(const Target& target, const std::string& aprilgrid_file) {
  TargetFields fields;
  fields.type = target.type;
  if (target.rim_mm >= 0) fields.rim_mm = target.rim_mm;
  if (target.type == TargetType::kAprilgrid) {
    fields.file = aprilgrid_file;
    return fields;
  }
  const std::array<int, 2> size{target.columns, target.rows};
  if (target.has_circles()) {
    fields.grid = size;
    fields.pitch = target.pitch_x;
    if (target.circle_mm > 0) fields.diameter = target.circle_mm;
    return fields;
  }
  fields.inner_corners = size;
  fields.square = SquareSize{target.pitch_x, target.pitch_y};
  if (target.type != TargetType::kCharuco) return fields;
  fields.marker = target.marker_mm;
  fields.dictionary = target.dictionary;
  return fields;
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
  fields.target = target_fields(target, session.aprilgrid_file);
  for (const SessionSensor& sensor : session.sensors) {
    fields.sensors.push_back(
        {sensor.name, sensor.board, sensor.laser, std::nullopt, sensor.camera, std::nullopt, std::nullopt});
    if (!sensor.camera_fixed) fields.sensors.back().camera_fixed = false;
    if (sensor.no_laser) fields.sensors.back().laser = "none";
    fields.sensors.back().board_only = sensor.board_only;
    if (sensor.laser_planes > 1) fields.sensors.back().laser_planes = sensor.laser_planes;
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
