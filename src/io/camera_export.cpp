// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "core/error.h"
#include "io/camera_file.h"

namespace lightstripe {
namespace {

/// The fewest terms of OpenCV's counts that hold all which are not 0.
std::vector<double> used_terms(const Camera& camera, std::initializer_list<std::size_t> counts) {
  const auto& k = camera.distortion;
  for (const std::size_t count : counts)
    if (std::all_of(k.begin() + static_cast<std::ptrdiff_t>(count), k.end(),
                    [](double term) { return term == 0; }))
      return {k.begin(), k.begin() + static_cast<std::ptrdiff_t>(count)};
  return {};
}

[[noreturn]] void fail_no_equal(const std::string& format, const std::string& what) {
  throw Error(format, "has no " + what,
              "export as OpenCV's FileStorage, or calibrate with a leaner lens model");
}

std::string list(const std::vector<double>& values) { return fmt::format("{}", fmt::join(values, ", ")); }

std::vector<double> camera_matrix(const Camera& c) { return {c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1}; }

}  // namespace

std::string opencv_camera_yaml(const Camera& camera) {
  const auto terms = used_terms(camera, {5, 8, 12, 14});
  const auto matrix = [](const std::string& name, std::size_t rows, std::size_t columns,
                         const std::vector<double>& data) {
    // A '.' tells OpenCV's parser of old that a number is no integer.
    std::string text = fmt::format("{}: !!opencv-matrix\n   rows: {}\n   cols: {}\n   dt: d\n   data: [ ",
                                   name, rows, columns);
    for (std::size_t i = 0; i < data.size(); ++i)
      text += fmt::format("{}{:.17e}", i > 0 ? ", " : "", data[i]);
    return text + " ]\n";
  };
  return fmt::format("%YAML:1.0\n---\nimage_width: {}\nimage_height: {}\n", camera.width, camera.height) +
         matrix("camera_matrix", 3, 3, camera_matrix(camera)) +
         matrix("distortion_coefficients", 1, terms.size(), terms);
}

std::string ros_camera_info_yaml(const Camera& camera, const std::string& name) {
  const auto terms = used_terms(camera, {5, 8});
  if (terms.empty()) fail_no_equal("camera_info", "thin prism or tilt terms");
  const auto matrix = [](const std::string& key, std::size_t rows, std::size_t columns,
                         const std::vector<double>& data) {
    return fmt::format("{}:\n  rows: {}\n  cols: {}\n  data: [{}]\n", key, rows, columns, list(data));
  };
  return fmt::format("image_width: {}\nimage_height: {}\ncamera_name: {}\n", camera.width, camera.height,
                     name) +
         matrix("camera_matrix", 3, 3, camera_matrix(camera)) +
         fmt::format("distortion_model: {}\n", terms.size() == 5 ? "plumb_bob" : "rational_polynomial") +
         matrix("distortion_coefficients", 1, terms.size(), terms) +
         matrix("rectification_matrix", 3, 3, {1, 0, 0, 0, 1, 0, 0, 0, 1}) +
         matrix("projection_matrix", 3, 4,
                {camera.fx, 0, camera.cx, 0, 0, camera.fy, camera.cy, 0, 0, 0, 1, 0});
}

std::string mrcal_cameramodel(const Camera& camera, const Rigid3& cam_from_reference) {
  const auto& k = camera.distortion;
  const bool pinhole = std::all_of(k.begin(), k.end(), [](double term) { return term == 0; });
  const auto terms = pinhole ? std::vector<double>{} : used_terms(camera, {4, 5, 8, 12});
  if (!pinhole && terms.empty()) fail_no_equal("cameramodel", "tilted sensor");
  std::vector<double> intrinsics{camera.fx, camera.fy, camera.cx, camera.cy};
  intrinsics.insert(intrinsics.end(), terms.begin(), terms.end());
  const Eigen::AngleAxisd turn(cam_from_reference.rotation);
  const Eigen::Vector3d r = turn.angle() * turn.axis(), t = 1e-3 * cam_from_reference.translation;
  return fmt::format(
      "{{\n    'lensmodel':  'LENSMODEL_{}',\n\n    'intrinsics': [ {} ],\n\n"
      "    # Rodrigues rotation and translation (m), camera from reference\n    'extrinsics': [ {} ],\n\n"
      "    'imagersize': [ {}, {} ]\n}}\n",
      pinhole ? "PINHOLE" : fmt::format("OPENCV{}", terms.size()), list(intrinsics),
      list({r.x(), r.y(), r.z(), t.x(), t.y(), t.z()}), camera.width, camera.height);
}

}  // namespace lightstripe
