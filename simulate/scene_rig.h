// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The part of a scene that looks and lights: sensors, their laser sheets, and how light becomes grey levels.
// World frame: x = direction of travel, z = up, y = z cross x; mm.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "core/fields.h"
#include "simulate/speckle.h"

namespace lightstripe {

/// A sheet of laser light that fans out from a point. Across the sheet it is gaussian.
struct LaserSheet {
  Eigen::Vector3d source{2.0, 265.0, 240.0};  ///< mm, world at travel 0
  Eigen::Vector3d aim{0.0, 10.0, -75.0};      ///< mm, the fan's axis goes through it
  Eigen::Vector3d normal{1.0, 0.004, 0.0};    ///< of the sheet; its part along the axis is ignored
  double thickness_sigma_mm = 0.6;
  double brightness = 420;  ///< grey levels on white, perpendicular to the light, at the distance of `aim`
  double fan_deg = 60;      ///< full opening angle; the light fades towards its edge
};

template <class V>
void visit_fields(V&& v, LaserSheet& o) {
  v("source", o.source, "mm");
  v("aim", o.aim, "mm, the fan's axis goes through it");
  v("normal", o.normal, "of the sheet");
  v("thickness_sigma_mm", o.thickness_sigma_mm);
  v("brightness", o.brightness, "grey levels on white at the aim");
  v("fan_deg", o.fan_deg, "full opening angle");
}

/// A camera and its laser. Each camera sees its own laser only (they fire in turn, or differ in colour).
struct SceneSensor {
  std::string name = "gauge";
  Eigen::Vector3d position{-353.0, 308.0, 222.0};  ///< projection centre, mm, world at travel 0
  Eigen::Vector3d target{0.0, 11.0, -75.0};        ///< what the optical axis goes through
  Eigen::Vector3d up{0.0, 0.0, 1.0};               ///< points up in the image
  std::array<int, 2> image_size{960, 700};
  std::array<double, 2> focal_px{1642.3, 1640.8};
  std::array<double, 2> principal_point_px{486.2, 343.1};
  std::vector<double> distortion{-0.092, 0.118, 0.0007, -0.0005, -0.046};  ///< OpenCV's order
  LaserSheet laser;
};

template <class V>
void visit_fields(V&& v, SceneSensor& o) {
  v("name", o.name);
  v("position", o.position, "mm");
  v("target", o.target, "mm, on the optical axis");
  v("up", o.up, "points up in the image");
  v("image_size", o.image_size, "px");
  v("focal_px", o.focal_px);
  v("principal_point_px", o.principal_point_px);
  v("distortion", o.distortion, "k1 k2 p1 p2 k3 [k4 k5 k6 [s1 s2 s3 s4 [tau_x tau_y]]]");
  v("laser", o.laser);
}

/// One sensor at +y ("gauge") and its twin at -y ("field"), their laser sheets nearly in one plane across the
/// rail.
std::vector<SceneSensor> two_sensor_rail_rig();

enum class Pictures { kGrey, kRgb, kBayer };
constexpr std::array<EnumName<Pictures>, 3> enum_names(Pictures) {
  return {{{Pictures::kGrey, "grey"}, {Pictures::kRgb, "rgb"}, {Pictures::kBayer, "bayer"}}};
}

enum class LaserHue { kRed, kGreen, kBlue };
constexpr std::array<EnumName<LaserHue>, 3> enum_names(LaserHue) {
  return {{{LaserHue::kRed, "red"}, {LaserHue::kGreen, "green"}, {LaserHue::kBlue, "blue"}}};
}

/// A colour camera: ambient light is white, the laser shines into its own channel and leaks into the others,
/// so that an overexposed stripe has a white core and a coloured rim.
struct ColourCamera {
  Pictures pictures = Pictures::kGrey;
  LaserHue laser = LaserHue::kRed;
  double crosstalk = 0.12;
};

template <class V>
void visit_fields(V&& v, ColourCamera& o) {
  v("pictures", o.pictures,
    "grey (the laser's own channel) | rgb | bayer (RGGB mosaic as the sensor gives it)");
  v("laser", o.laser, "red | green | blue");
  v("crosstalk", o.crosstalk, "share of the laser in the neighbouring channel; its square in the one beyond");
}

/// From light to grey levels. Ambient levels: a white surface that faces the lamp.
struct Imaging {
  double board_ambient = 215;             ///< board images, laser off
  double laser_ambient = 45;              ///< board images, laser on (darkened so that the stripe stands out)
  double single_ambient = 150;            ///< board images that show board and stripe at once
  double single_laser = 0.45;             ///< the laser's share of its power in those images
  double scan_ambient = 30;               ///< frames of the scan
  double dark_level = 5;                  ///< what a pixel without light reads
  Eigen::Vector3d light{-0.6, 0.1, 0.8};  ///< towards the soft lamp
  double exposure = 1;                    ///< multiplies all light
  double blur_sigma_px = 0.7;             ///< lens
  double read_noise = 1.5;                ///< grey levels, 1 sigma
  double electrons_per_level = 40;        ///< shot noise: variance = level / this; 0 = none
  int samples = 16;                       ///< rays a pixel where the picture changes: 1, or 4, 8, 16 ...
  Speckle speckle;                        ///< the laser light's grain
  ColourCamera colour;

  /// Whether the laser's light has to be known apart from the lamp's.
  bool separates_laser() const { return speckle.contrast > 0 || colour.pictures != Pictures::kGrey; }
};

template <class V>
void visit_fields(V&& v, Imaging& o) {
  v("board_ambient", o.board_ambient, "grey level of white, board images without laser");
  v("laser_ambient", o.laser_ambient, "the same, board images with laser");
  v("single_ambient", o.single_ambient, "the same, board and stripe in one image");
  v("single_laser", o.single_laser, "share of the laser's power in those");
  v("scan_ambient", o.scan_ambient, "the same, frames of the scan");
  v("dark_level", o.dark_level, "what a pixel without light reads");
  v("light", o.light, "direction towards the soft lamp");
  v("exposure", o.exposure, "multiplies all light");
  v("blur_sigma_px", o.blur_sigma_px, "lens");
  v("read_noise", o.read_noise, "grey levels, 1 sigma");
  v("electrons_per_level", o.electrons_per_level, "shot noise; 0 = none");
  v("samples", o.samples, "rays a pixel where the picture changes: 1, 4, 8, 16, ...");
  v("speckle", o.speckle);
  v("colour", o.colour);
}

}  // namespace lightstripe
