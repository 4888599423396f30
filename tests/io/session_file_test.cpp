// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/session_file.h"

#include <gmock/gmock.h>

#include "tests/io/temp_folder.h"

namespace lightstripe {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

// The contract's own examples.
constexpr const char* kSession = R"(target: {type: checkerboard, inner_corners: [11, 8], square: 10.0}
sensors:
  - name: gauge
    board: calib/gauge/board/*.png      # laser off
    laser: calib/gauge/laser/*.png
  - name: field
    board: calib/field/board/*.png
    laser_planes: 2
motion: {type: linear, sensor: gauge, board: calib/gauge/travel/*.png, travel: calib/travel.csv, moves: object}
up: [0.0, -1.0, 0.25]
channel: red-excess
extraction: {sigma: 3}
)";

constexpr const char* kScan = R"(rig: rig.yaml
frames:
  gauge: scan/gauge/*.png        # images in natural order
  field: scan/field.mp4
travel: {file: scan/travel.csv}
extraction: {stripe_width: 6}
)";

/// `text` with the first `from` replaced.
std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string session_complaint(const std::string& text) {
  const TempFolder folder;
  const std::string message = error_of([&] { read_session(folder.write("s.yaml", text)); });
  return message.substr(std::min(message.find("s.yaml"), message.size()));
}

std::string scan_complaint(const std::string& text) {
  const TempFolder folder;
  const std::string message = error_of([&] { read_scan(folder.write("s.yaml", text)); });
  return message.substr(std::min(message.find("s.yaml"), message.size()));
}

TEST(Session, ReadsTheContractsExample) {
  const TempFolder folder;
  const Session session = read_session(folder.write("s.yaml", kSession));
  EXPECT_EQ(session.folder, folder.path());
  EXPECT_EQ(session.target.columns, 11);
  EXPECT_EQ(session.target.rows, 8);
  EXPECT_EQ(session.target.pitch_x, 10.0);
  EXPECT_EQ(session.target.pitch_y, 10.0);
  ASSERT_EQ(session.sensors.size(), 2U);
  EXPECT_EQ(session.sensors[0].name, "gauge");
  EXPECT_EQ(session.sensors[0].board, "calib/gauge/board/*.png");
  EXPECT_EQ(session.sensors[0].laser, "calib/gauge/laser/*.png");
  EXPECT_EQ(session.sensors[0].laser_planes, 1);
  EXPECT_EQ(session.sensors[1].laser, std::nullopt);
  EXPECT_EQ(session.sensors[1].laser_planes, 2);
  ASSERT_TRUE(session.motion.has_value());
  EXPECT_EQ(session.motion->type, MotionType::kLinear);
  EXPECT_EQ(session.motion->sensor, "gauge");
  EXPECT_EQ(session.motion->travel, "calib/travel.csv");
  EXPECT_EQ(session.motion->moves, Moves::kObject);
  EXPECT_EQ(session.up, Eigen::Vector3d(0, -1, 0.25));
  EXPECT_EQ(session.channel, Channel::kRedExcess);
  EXPECT_FALSE(session.extraction.empty());
  EXPECT_TRUE(session.calibration.empty());
}

TEST(Session, WhatIsLeftOutHasTheContractsDefault) {
  const TempFolder folder;
  const Session session = read_session(folder.write(
      "s.yaml",
      "target: {inner_corners: [11, 7], square: [21.167, 21.125]}\nsensors: [{name: a, board: '*.png'}]\n"));
  EXPECT_EQ(session.target.pitch_x, 21.167);
  EXPECT_EQ(session.target.pitch_y, 21.125);
  EXPECT_EQ(session.motion, std::nullopt);
  EXPECT_EQ(session.up, Eigen::Vector3d(0, -1, 0));
  EXPECT_EQ(session.channel, Channel::kAuto);
}

TEST(Session, IsWrittenAsItIsRead) {
  const TempFolder folder;
  const Session before = read_session(folder.write("s.yaml", kSession));
  const std::string text = session_to_yaml(before);
  const Session after = read_session(folder.write("t.yaml", text));
  EXPECT_EQ(session_to_yaml(after), text);
  EXPECT_EQ(after.sensors[1].laser_planes, 2);
  EXPECT_EQ(after.motion->board, before.motion->board);
  EXPECT_EQ(after.motion->moves, Moves::kObject);
  EXPECT_EQ(after.channel, Channel::kRedExcess);
  EXPECT_THAT(text, HasSubstr("extraction: {sigma: 3}\n"));
}

TEST(Session, NamesTheKeyThatIsWrong) {
  const std::string good = kSession;
  EXPECT_EQ(session_complaint(good), "");
  EXPECT_THAT(session_complaint(with(good, "target:", "tarket:")),
              HasSubstr("s.yaml: tarket (line 1): unknown key; did you mean 'target'?"));
  EXPECT_THAT(session_complaint("sensors: [{name: a, board: b}]\n"), HasSubstr("s.yaml: target: is missing"));
  EXPECT_THAT(session_complaint(with(good, "square: 10.0", "square: 0")),
              HasSubstr("target.square: is not positive"));
  EXPECT_THAT(session_complaint(with(good, "square: 10.0", "square: [1, 2, 3]")),
              HasSubstr("target.square (line 1): is a list of 3"));
  EXPECT_THAT(session_complaint(with(good, "square: 10.0", "square: [1, .nan]")),
              HasSubstr("target.square[1] (line 1)"));
  EXPECT_THAT(session_complaint(with(good, "[11, 8]", "[11, 1]")),
              HasSubstr("target.inner_corners: is out of range"));
  EXPECT_THAT(session_complaint(with(good, "[11, 8]", "[1001, 8]")),
              HasSubstr("target.inner_corners: is out of range"));
  EXPECT_THAT(session_complaint(with(good, "name: field", "name: gauge")),
              HasSubstr("sensors[1].name: is the name of an earlier"));
  EXPECT_THAT(session_complaint(with(good, "name: field", "name: ''")),
              HasSubstr("sensors[1].name: is empty"));
  EXPECT_THAT(session_complaint(with(good, "name: field", "name: rig")), HasSubstr("reserved"));
  EXPECT_THAT(session_complaint(with(good, "laser_planes: 2", "laser_planes: 0")),
              HasSubstr("sensors[1].laser_planes: is out of range"));
  EXPECT_THAT(session_complaint(with(good, "sensor: gauge", "sensor: none")),
              HasSubstr("motion.sensor: names no sensor"));
  EXPECT_THAT(session_complaint(with(good, "travel: calib/travel.csv, ", "")),
              HasSubstr("motion.travel: is missing"));
  EXPECT_THAT(session_complaint(with(good, "type: linear", "type: circular")),
              HasSubstr("motion.type (line 9): is 'circular'; allowed: linear, rotary"));
  EXPECT_THAT(session_complaint(with(good, "moves: object", "moves: me")), HasSubstr("allowed: rig, object"));
  EXPECT_THAT(session_complaint(with(good, "[0.0, -1.0, 0.25]", "[0, 0, 0]")),
              HasSubstr("up: is a zero vector"));
  EXPECT_THAT(session_complaint(with(good, "channel: red-excess", "channel: redexcess")),
              HasSubstr("did you mean 'red-excess'?"));
}

TEST(Session, ReadsACharucoTarget) {
  EXPECT_THAT(session_complaint(with(kSession, "checkerboard", "charuco")),
              HasSubstr("target.marker: is missing"));
  const TempFolder folder;
  const Session session = read_session(folder.write(
      "s.yaml", with(kSession, "checkerboard", "charuco, marker: 7.5, dictionary: DICT_5X5_100")));
  EXPECT_EQ(session.target.type, TargetType::kCharuco);
  EXPECT_EQ(session.target.marker_mm, 7.5);
  EXPECT_EQ(session.target.dictionary, "DICT_5X5_100");
  EXPECT_THAT(session_complaint(with(kSession, "checkerboard", "checkerboard, marker: 7")),
              HasSubstr("say type: charuco"));
}

TEST(Session, ReadsGivenCameras) {
  const TempFolder folder;
  const Session session = read_session(folder.write(
      "s.yaml",
      with(kSession, "name: gauge", "name: gauge\n    camera: cameras/gauge.yaml\n    camera_fixed: false")));
  EXPECT_EQ(session.sensors[0].camera, "cameras/gauge.yaml");
  EXPECT_FALSE(session.sensors[0].camera_fixed);
  EXPECT_FALSE(session.sensors[1].camera);
  EXPECT_THAT(session_complaint(with(kSession, "name: gauge", "name: gauge\n    camera_fixed: true")),
              HasSubstr("camera_fixed"));
}

TEST(Scan, ReadsTheContractsExample) {
  const TempFolder folder;
  const Scan scan = read_scan(folder.write("s.yaml", kScan));
  EXPECT_EQ(scan.folder, folder.path());
  EXPECT_EQ(scan.rig, "rig.yaml");
  EXPECT_THAT(scan.frames, ElementsAre(Pair("gauge", "scan/gauge/*.png"), Pair("field", "scan/field.mp4")));
  EXPECT_EQ(scan.travel, TravelSource::kFile);
  EXPECT_EQ(scan.travel_file, "scan/travel.csv");
  EXPECT_EQ(scan.extraction.origin, (folder / "s.yaml").string() + ": extraction");
}

TEST(Scan, TakesEveryFormOfTravelAndWritesItBack) {
  const TempFolder folder;
  const auto read_with = [&](const std::string& travel) {
    const Scan scan = read_scan(folder.write("s.yaml", with(kScan, "{file: scan/travel.csv}", travel)));
    return read_scan(folder.write("t.yaml", scan_to_yaml(scan)));
  };
  const Scan step = read_with("{step: -2.5}");
  EXPECT_EQ(step.travel, TravelSource::kStep);
  EXPECT_EQ(step.travel_step, -2.5);
  const Scan poses = read_with("{poses: poses.csv, of: gauge}");
  EXPECT_EQ(poses.travel, TravelSource::kPoses);
  EXPECT_EQ(poses.poses_file, "poses.csv");
  EXPECT_EQ(poses.poses_of, "gauge");
  const Scan none = read_with("");
  EXPECT_EQ(none.travel, TravelSource::kNone);
  EXPECT_EQ(none.frames.size(), 2U);
}

TEST(Scan, BackgroundIsOneTextOrAMapOfSensors) {
  const TempFolder folder;
  const std::string one = "rig: rig.yaml\nframes: {gauge: a/*.png}\nbackground: off/*.png\n";
  const Scan scan = read_scan(folder.write("s.yaml", one));
  EXPECT_EQ(scan.background.pattern("gauge"), "off/*.png");
  EXPECT_EQ(read_scan(folder.write("t.yaml", scan_to_yaml(scan))).background.pattern("gauge"), "off/*.png");
  const Scan two = read_scan(folder.write("s.yaml", std::string(kScan) + "background: {field: off.png}\n"));
  EXPECT_EQ(two.background.pattern("gauge"), "");
  EXPECT_EQ(two.background.pattern("field"), "off.png");
  EXPECT_EQ(read_scan(folder.write("t.yaml", scan_to_yaml(two))).background.pattern("field"), "off.png");
  EXPECT_THAT(scan_complaint(std::string(kScan) + "background: off.png\n"),
              HasSubstr("background: is one for several sensors; give each its own"));
  EXPECT_THAT(scan_complaint(std::string(kScan) + "background: {other: off.png}\n"),
              HasSubstr("background.other: names no sensor of frames"));
}

TEST(Session, BackgroundBelongsToASensorOrToTheOnlyOne) {
  const TempFolder folder;
  const std::string one =
      "target: {inner_corners: [11, 7], square: 10}\nsensors: [{name: a, board: '*.png'}]\nbackground: "
      "off.png\n";
  const Session session = read_session(folder.write("s.yaml", one));
  EXPECT_EQ(session.sensors[0].background, "off.png");
  EXPECT_EQ(read_session(folder.write("t.yaml", session_to_yaml(session))).sensors[0].background, "off.png");
  EXPECT_THAT(session_complaint(std::string(kSession) + "background: off.png\n"),
              HasSubstr("background: is one for several sensors"));
  EXPECT_THAT(session_complaint(std::string(kSession) + "background: {other: off.png}\n"),
              HasSubstr("background.other: names no sensor"));
}

TEST(Scan, NamesTheKeyThatIsWrong) {
  const std::string good = kScan;
  const auto bad_travel = [&good](const std::string& travel) {
    return scan_complaint(with(good, "{file: scan/travel.csv}", travel));
  };
  EXPECT_EQ(scan_complaint(good), "");
  EXPECT_THAT(bad_travel("{}"), HasSubstr("s.yaml: travel: says nothing; give one of {file: travel.csv}"));
  EXPECT_THAT(bad_travel("{file: a.csv, step: 2}"), HasSubstr("travel: says more than one thing"));
  EXPECT_THAT(bad_travel("{poses: a.csv}"), HasSubstr("poses need to know whose they are"));
  EXPECT_THAT(bad_travel("{step: 2, of: gauge}"), HasSubstr("'of' goes with poses only"));
  EXPECT_THAT(bad_travel("{step: 0}"), HasSubstr("travel.step: is 0"));
  EXPECT_THAT(bad_travel("{step: .inf}"), HasSubstr("travel.step (line 5): is '.inf'; give a finite number"));
  EXPECT_THAT(bad_travel("scan/travel.csv"), HasSubstr("travel (line 5): is 'scan/travel.csv'; give a map"));
  EXPECT_THAT(scan_complaint(with(good, "rig: rig.yaml", "channel: auto")),
              HasSubstr("s.yaml: rig: is missing"));
  EXPECT_THAT(scan_complaint("rig: rig.yaml\n"), HasSubstr("s.yaml: frames: is missing or empty"));
  EXPECT_THAT(scan_complaint("rig: rig.yaml\nframes: {a: ''}\n"), HasSubstr("frames.a: is empty"));
  EXPECT_THAT(scan_complaint("rig: rig.yaml\nframes: {a: x, a: y}\n"),
              HasSubstr("frames.a (line 2): given twice"));
}

}  // namespace
}  // namespace lightstripe
