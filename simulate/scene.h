// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A scene as a user writes it (configs/scenes/*.yaml): rig, calibration session, scan, objects. The default
// is the demo's two-sensor rail rig before a new 60E1.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/fields.h"
#include "core/rig.h"
#include "simulate/scene_objects.h"
#include "simulate/scene_rig.h"

namespace lightstripe {

enum class BoardImages { kPair, kSingle };
constexpr std::array<EnumName<BoardImages>, 2> enum_names(BoardImages) {
  return {{{BoardImages::kPair, "pair"}, {BoardImages::kSingle, "single"}}};
}

/// The checkerboard and the poses that it is shown in: random, but seen whole by every sensor and crossed by
/// every laser.
struct BoardPlan {
  int count = 20;
  std::array<int, 2> inner_corners{11, 8};
  std::array<double, 2> square_mm{10, 10};
  double quiet_border_mm = 12;  ///< white rim around the outer squares
  double white_albedo = 0.85, black_albedo = 0.08;
  Eigen::Vector3d center{0.0, 0.0, -75.0};   ///< middle of the places that the board's middle takes
  Eigen::Vector3d spread{30.0, 45.0, 60.0};  ///< largest distance from it along x, y, z
  double max_tilt_deg = 38;                  ///< against the direction that faces all cameras
  double max_roll_deg = 30;                  ///< about the board's normal
  double margin_px = 12;                     ///< between the outer squares and the image's edge
  int cut_off = 0;  ///< this many of the poses leave the first sensor's image in part
  BoardImages images = BoardImages::kPair;
};

template <class V>
void visit_fields(V&& v, BoardPlan& o) {
  v("count", o.count, "poses");
  v("inner_corners", o.inner_corners);
  v("square_mm", o.square_mm);
  v("quiet_border_mm", o.quiet_border_mm);
  v("white_albedo", o.white_albedo);
  v("black_albedo", o.black_albedo);
  v("center", o.center, "mm, middle of the boards' places");
  v("spread", o.spread, "mm, largest distance from it");
  v("max_tilt_deg", o.max_tilt_deg);
  v("max_roll_deg", o.max_roll_deg);
  v("margin_px", o.margin_px);
  v("cut_off", o.cut_off, "poses that leave the first sensor's image in part");
  v("images", o.images, "pair: laser off and on; single: board and stripe in one");
}

/// One board, fixed to the object, seen while the rig travels or the object turns (where the scene has a
/// wheel). No positions: no motion calibration.
struct MotionPlan {
  int positions = 10;
  double step_mm = 10;
  double step_deg = 2;
  std::string sensor;  ///< who looks; empty: the first
  Moves moves = Moves::kRig;
};

template <class V>
void visit_fields(V&& v, MotionPlan& o) {
  v("positions", o.positions, "images of the motion calibration; 0: none");
  v("step_mm", o.step_mm);
  v("step_deg", o.step_deg, "instead, where the scene has a wheel");
  v("sensor", o.sensor, "who looks; empty: the first");
  v("moves", o.moves);
}

struct ScanPlan {
  int frames = 40;
  double step_mm = 2;
  double step_deg = 9;
  double sway_deg = 0, sway_mm = 0;  ///< not 0: the rig is led by hand, its poses are known (poses.csv)
  double truth_spacing_mm = 0.1;     ///< between the points of truth/sections.csv
};

template <class V>
void visit_fields(V&& v, ScanPlan& o) {
  v("frames", o.frames);
  v("step_mm", o.step_mm);
  v("step_deg", o.step_deg, "instead, where the scene has a wheel");
  v("sway_deg", o.sway_deg, "turns of a rig led by hand, largest; its poses are then known");
  v("sway_mm", o.sway_mm, "its excursions, largest");
  v("truth_spacing_mm", o.truth_spacing_mm, "between the points of truth/sections.csv");
}

/// Bright elliptic blobs at random places of the scan's frames (mirror images of lamps), saturated,
/// soft-edged.
struct Reflections {
  int per_frame = 2;
  std::array<double, 2> radius_px{3, 20};
  double peak = 600;     ///< grey levels before clipping
  double edge_px = 1.5;  ///< softness of the rim
};

template <class V>
void visit_fields(V&& v, Reflections& o) {
  v("per_frame", o.per_frame);
  v("radius_px", o.radius_px, "smallest, largest");
  v("peak", o.peak, "grey levels before clipping");
  v("edge_px", o.edge_px, "softness of the rim");
}

struct Scene {
  std::int64_t seed = 1;
  std::vector<SceneSensor> sensors = two_sensor_rail_rig();
  Imaging imaging;
  BoardPlan boards;
  MotionPlan motion;
  ScanPlan scan;
  Reflections reflections;
  RailObject rail;
  RailObject other_rail{.profile = "none"};  ///< of a track; its truth lies in other_sections.csv
  WheelObject wheel;
  std::vector<StepsObject> steps;
  std::vector<SphereObject> spheres;
  std::vector<CylinderObject> cylinders;
  std::optional<GroundObject> ground;

  bool turns() const { return wheel.present(); }
  bool has_poses() const { return scan.sway_deg != 0 || scan.sway_mm != 0; }

  /// Throws Error naming the field and the rule; `origin` (the file) stands before it.
  void check(const std::string& origin = "") const;
};

template <class V>
void visit_fields(V&& v, Scene& o) {
  v("seed", o.seed);
  v("sensors", o.sensors);
  v("imaging", o.imaging);
  v("boards", o.boards);
  v("motion", o.motion);
  v("scan", o.scan);
  v("reflections", o.reflections);
  v("rail", o.rail);
  v("other_rail", o.other_rail, "the track's second rail");
  v("wheel", o.wheel);
  v("steps", o.steps);
  v("spheres", o.spheres);
  v("cylinders", o.cylinders);
  v("ground", o.ground);
}

/// The demo's rig before a worn wheel on a turning stand, one turn (configs/scenes/wheel.yaml).
Scene wheel_scene();

/// Reads scene.yaml; keys left out keep their defaults; an outline file (rail.profile) is relative to the
/// scene's folder. Errors name file, key and rule.
Scene read_scene(const std::filesystem::path& path);

}  // namespace lightstripe
