// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What stands before the rig: a rail, staircases, balls, cylinders, the ground. World frame at travel 0, mm.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "core/fields.h"

namespace lightstripe {

/// Stains, grain, machining marks: the albedo varies over the surface.
struct Texture {
  double contrast = 0;  ///< standard deviation / mean
  double grain_mm = 1;  ///< size of the spots
};

template <class V>
void visit_fields(V&& v, Texture& o) {
  v("contrast", o.contrast, "standard deviation / mean of the albedo; 0: even");
  v("grain_mm", o.grain_mm, "size of the spots");
}

/// Laser light that spreads below the surface (plastic, marble, skin): a tail on one side of the stripe.
struct Glow {
  double share = 0;     ///< of the stripe's peak
  double reach_mm = 2;  ///< over which it falls to 1/e
};

template <class V>
void visit_fields(V&& v, Glow& o) {
  v("share", o.share, "peak of the tail over that of the stripe; 0: opaque");
  v("reach_mm", o.reach_mm, "over which the tail falls to 1/e");
}

/// Matt (Lambert) reflection with an optional highlight (Phong).
struct Material {
  double albedo = 0.6;
  double specular = 0;    ///< share of the light in the highlight's middle
  double shininess = 30;  ///< Phong's exponent
  Texture texture = {};
  Glow glow = {};
};

template <class V>
void visit_fields(V&& v, Material& o) {
  v("albedo", o.albedo);
  v("specular", o.specular);
  v("shininess", o.shininess);
  v("texture", o.texture);
  v("glow", o.glow);
}

/// Which face of a rail's head the wheels' flanges wear.
enum class WornFace { kLeft, kRight };
constexpr std::array<EnumName<WornFace>, 2> enum_names(WornFace) {
  return {{{WornFace::kLeft, "left"}, {WornFace::kRight, "right"}}};
}

/// An endless rail along x. Wear grows linearly from the first frame to the last; each frame sees one
/// constant section.
struct RailObject {
  std::string profile = "60E1";                  ///< nominal outline: a name, a file, or "none" for no rail
  Eigen::Vector3d top{0.0, 0.0, 0.0};            ///< where the outline's origin (top of rail) stands
  double inclination_deg = 0;                    ///< about x, positive turns the top towards -y
  std::array<double, 2> vertical_wear_mm{0, 0};  ///< at the first and the last frame
  std::array<double, 2> side_wear_mm{0, 0};      ///< of the gauge face
  WornFace gauge_side = WornFace::kLeft;         ///< left: the gauge face looks towards +y; right: to -y
  Material material = {};

  bool present() const { return profile != "none"; }
};

template <class V>
void visit_fields(V&& v, RailObject& o) {
  v("profile", o.profile, "nominal outline: a name, a file, or none");
  v("top", o.top, "mm, the outline's origin");
  v("inclination_deg", o.inclination_deg, "about x");
  v("vertical_wear_mm", o.vertical_wear_mm, "first frame, last frame");
  v("side_wear_mm", o.side_wear_mm, "gauge face: first frame, last frame");
  v("gauge_side", o.gauge_side, "left: the gauge face looks to +y; right: to -y");
  v("material", o.material);
}

/// A railway wheel that turns about its axis while the sensors stand (or the sensors about it). All around it
/// has one section.
struct WheelObject {
  std::string profile = "none";              ///< nominal section: a name, a file, or "none" for no wheel
  Eigen::Vector3d center{0.0, 0.0, -490.0};  ///< on the axis it turns about, in the plane of the tread datum
  Eigen::Vector3d axis{0.0, 1.0, 0.0};       ///< towards the field side
  double diameter_mm = 920;                  ///< of the unworn tread at the datum
  double flange_wear_mm = 0;                 ///< of the active face, towards the back
  double tread_wear_mm = 0;                  ///< of the tread at the datum, radial
  double eccentricity_mm = 0;  ///< of the section's axis from the one it turns about, upwards at 0 degrees
  Material material;

  bool present() const { return profile != "none"; }
};

template <class V>
void visit_fields(V&& v, WheelObject& o) {
  v("profile", o.profile, "nominal section: a name, a file, or none");
  v("center", o.center, "mm, on the axis, in the plane of the tread datum");
  v("axis", o.axis, "towards the field side");
  v("diameter_mm", o.diameter_mm, "of the unworn tread at the datum");
  v("flange_wear_mm", o.flange_wear_mm, "of the active face");
  v("tread_wear_mm", o.tread_wear_mm, "at the datum, radial");
  v("eccentricity_mm", o.eccentricity_mm, "of the section's axis, upwards at 0 degrees");
  v("material", o.material);
}

/// A staircase: treads of `run_mm` that rise to `heights_mm`, side by side along y, centred on `base`.
struct StepsObject {
  Eigen::Vector3d base{0.0, 0.0, -60.0};
  std::vector<double> heights_mm{10, 20, 30, 20, 10};
  double run_mm = 20;
  double length_mm = 400;  ///< along x before yaw
  double yaw_deg = 0;      ///< about z; 90: the treads follow each other along x
  Material material;
};

template <class V>
void visit_fields(V&& v, StepsObject& o) {
  v("base", o.base, "mm, middle of the base");
  v("heights_mm", o.heights_mm, "of the treads above the base");
  v("run_mm", o.run_mm, "width of a tread");
  v("length_mm", o.length_mm, "along x before yaw");
  v("yaw_deg", o.yaw_deg, "about z");
  v("material", o.material);
}

struct SphereObject {
  Eigen::Vector3d center{0.0, 0.0, -60.0};
  double radius_mm = 30;
  Material material;
};

template <class V>
void visit_fields(V&& v, SphereObject& o) {
  v("center", o.center, "mm");
  v("radius_mm", o.radius_mm);
  v("material", o.material);
}

struct CylinderObject {
  Eigen::Vector3d center{0.0, 0.0, -60.0};
  Eigen::Vector3d axis{1.0, 0.0, 0.0};
  double radius_mm = 30;
  double length_mm = 150;
  Material material;
};

template <class V>
void visit_fields(V&& v, CylinderObject& o) {
  v("center", o.center, "mm");
  v("axis", o.axis);
  v("radius_mm", o.radius_mm);
  v("length_mm", o.length_mm);
  v("material", o.material);
}

/// The endless plane z = height_mm.
struct GroundObject {
  double height_mm = -172;
  Material material;
};

template <class V>
void visit_fields(V&& v, GroundObject& o) {
  v("height_mm", o.height_mm, "z of the ground");
  v("material", o.material);
}

}  // namespace lightstripe
