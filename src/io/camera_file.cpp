// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/camera_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/counted.h"
#include "core/error.h"
#include "io/atomic_file.h"
#include "io/rig_file.h"
#include "io/yaml_binding.h"

namespace lightstripe {
namespace {

using detail::YamlNode;
using detail::YamlPlace;

constexpr std::size_t kMaxBytes = std::size_t{16} << 20;

const YamlNode* find(const YamlNode& map, std::initializer_list<std::string_view> names) {
  for (const YamlNode& item : map.items)
    if (std::find(names.begin(), names.end(), item.key) != names.end()) return &item;
  return nullptr;
}

const YamlNode& given(const YamlNode& map, std::initializer_list<std::string_view> names,
                      const YamlPlace& place) {
  const YamlNode* node = find(map, names);
  if (!node) throw Error(place.file, "has no " + std::string(*names.begin()), "give a complete camera file");
  return *node;
}

/// Numbers of a list, or of the data of an OpenCV or ROS matrix.
std::vector<double> numbers(const YamlNode& node, const YamlPlace& place) {
  const YamlNode* data = node.kind == YamlNode::Kind::kMap ? find(node, {"data"}) : &node;
  if (!data)
    detail::fail_at(place.child(node.key), node.line, "has no data",
                    "give a matrix with rows, cols and data");
  std::vector<double> values;
  detail::read_field(*data, values, place.child(node.key));
  return values;
}

int number(const YamlNode* node, const YamlPlace& place) {
  int value = 0;
  if (node) detail::read_field(*node, value, place.child(node->key));
  return value;
}

/// OpenCV's YAML has a first line and tags that YAML 1.2 does not know.
std::string plain_yaml(std::string text) {
  if (text.starts_with("%YAML:")) text[0] = '#';
  for (const std::string tag : {"!!opencv-matrix", "!<tag:yaml.org,2002:opencv-matrix>"})
    for (auto at = text.find(tag); at != std::string::npos; at = text.find(tag)) text.erase(at, tag.size());
  // `ros2 topic echo` ends each message with a line of its own.
  const std::size_t last = text.find_last_not_of(" \r\n");
  if (last != std::string::npos && last >= 3 && text.compare(last - 3, 4, "\n---") == 0)
    text.resize(last - 2);
  return text;
}

void set_distortion(Camera& camera, const std::vector<double>& terms, const YamlPlace& place) {
  constexpr std::array<std::size_t, 6> kCounts{0, 4, 5, 8, 12, 14};
  if (std::find(kCounts.begin(), kCounts.end(), terms.size()) == kCounts.end())
    throw Error(place.file, "has " + counted(terms.size(), "distortion term"),
                "give 4, 5, 8, 12 or 14 in OpenCV's order");
  std::copy(terms.begin(), terms.end(), camera.distortion.begin());
}

/// [fx 0 cx; 0 fy cy; 0 0 1], row by row.
void check_matrix(const std::vector<double>& K, const YamlPlace& place) {
  const double tiny = 1e-9 * (std::abs(K[0]) + std::abs(K[4]));
  const auto is_zero = [&](std::size_t i) { return std::abs(K[i]) <= tiny; };
  if (is_zero(2) && is_zero(5) && !is_zero(6) && !is_zero(7))
    throw Error(place.file, "has a camera matrix written by columns (MATLAB's IntrinsicMatrix)",
                "write it row by row: [fx, 0, cx, 0, fy, cy, 0, 0, 1]");
  if (!is_zero(6) || !is_zero(7) || std::abs(K[8] - 1) > 1e-9)
    throw Error(place.file, "has a camera matrix whose last row is not 0 0 1",
                "write [fx, 0, cx, 0, fy, cy, 0, 0, 1]");
  if (!is_zero(1) || !is_zero(3))
    throw Error(place.file,
                fmt::format("has a camera matrix with skew ({:.4g} px)", is_zero(1) ? K[3] : K[1]),
                "calibrate without skew, or leave the camera out");
}

/// Fisheye models have four terms too, which must not pass for k1 k2 p1 p2.
void refuse_fisheye(const YamlNode& root, const Camera& camera, const YamlPlace& place) {
  constexpr double kMaxTangential = 0.05;  // a decentred lens has 0.001, a bad one 0.01
  // What p1, p2 move a point in the picture's corner, over its distance from the middle: 0.003 for a usual
  // lens, 0.01 for a bad one. In wide pictures small coefficients move far.
  constexpr double kMaxShift = 0.025;
  const std::string what_to_do = "calibrate with OpenCV's pinhole model (plumb_bob), or leave the camera out";
  const YamlNode* flag = find(root, {"fisheye_model", "fisheye"});
  if (flag && flag->text != "0" && flag->text != "false")
    throw Error(place.file, "holds a camera of the fisheye model", what_to_do);
  const double tangential = std::max(std::abs(camera.distortion[2]), std::abs(camera.distortion[3]));
  const double corner = std::hypot(std::max(camera.cx, camera.width - camera.cx) / camera.fx,
                                   std::max(camera.cy, camera.height - camera.cy) / camera.fy);
  if (tangential > kMaxTangential || 3 * tangential * corner > kMaxShift)
    throw Error(
        place.file,
        fmt::format("has tangential terms p1, p2 of {:.3g}, as no lens has{}: they look like a fisheye "
                    "(equidistant) model's",
                    tangential,
                    camera.width > 0 ? fmt::format(" (they move the picture's corner by {:.0f} px)",
                                                   3 * tangential * corner * corner * camera.fx)
                                     : ""),
        what_to_do);
}

/// OpenCV's FileStorage and ROS' camera_info differ in what stands beside these keys.
Camera matrix_camera(const YamlNode& root, const YamlPlace& place) {
  const YamlNode* model = find(root, {"distortion_model"});
  if (model && model->text != "plumb_bob" && model->text != "rational_polynomial")
    throw Error(place.file, "has the distortion model " + model->text,
                "calibrate with plumb_bob or rational_polynomial, or leave the camera out");
  const auto K = numbers(given(root, {"camera_matrix", "cameraMatrix", "K", "k", "M1"}, place), place);
  if (K.size() != 9)
    throw Error(place.file, "has a camera matrix that is not 3 x 3", "give 9 numbers row by row");
  check_matrix(K, place);
  Camera camera;
  camera.width = number(find(root, {"image_width", "width"}), place);
  camera.height = number(find(root, {"image_height", "height"}), place);
  camera.fx = K[0];
  camera.fy = K[4];
  camera.cx = K[2];
  camera.cy = K[5];
  const YamlNode* distortion = find(root, {"distortion_coefficients", "dist_coeffs", "distCoeffs",
                                           "distortionCoefficients", "D", "d", "D1"});
  if (distortion) set_distortion(camera, numbers(*distortion, place), place);
  refuse_fisheye(root, camera, place);
  return camera;
}

Camera kalibr_camera(const YamlNode& root, const std::string& name, const YamlPlace& place) {
  const YamlNode& node =
      given(root, {name.empty() ? std::string_view("cam0") : std::string_view(name)}, place);
  const YamlNode* model = find(node, {"camera_model"});
  const YamlNode* lens = find(node, {"distortion_model"});
  if (model && model->text != "pinhole")
    throw Error(place.file, "has the camera model " + model->text,
                "calibrate with pinhole, or leave the camera out");
  if (lens && lens->text != "radtan" && lens->text != "none")
    throw Error(place.file, "has the distortion model " + lens->text,
                "calibrate with radtan, or leave the camera out");
  const auto f = numbers(given(node, {"intrinsics"}, place), place);
  if (f.size() != 4) throw Error(place.file, "has intrinsics that are not fu fv pu pv", "give 4 numbers");
  Camera camera{0, 0, f[0], f[1], f[2], f[3], {}};
  if (const YamlNode* terms = find(node, {"distortion_coeffs"}))
    set_distortion(camera, numbers(*terms, place), place);
  if (const YamlNode* size = find(node, {"resolution"})) {
    const auto sides = numbers(*size, place);
    constexpr double kLargestSide = 1e6;  // px
    for (const double side : sides)
      if (!(side >= 1 && side <= kLargestSide && side == std::floor(side)))
        throw Error(place.file, "has a resolution that is no picture's", "give width and height in px");
    if (sides.size() == 2)
      camera.width = static_cast<int>(sides[0]), camera.height = static_cast<int>(sides[1]);
  }
  return camera;
}

Camera rig_camera(const std::string& path, const std::string& name) {
  const Rig rig = read_rig(path, RigUse::kCameras);
  for (const Sensor& sensor : rig.sensors)
    if (name.empty() || sensor.name == name) return sensor.camera;
  throw Error(path, "has no sensor " + name, "give one of its names behind the #");
}

Camera checked(Camera camera, const std::string& path) {
  if (!(camera.fx > 0 && camera.fy > 0))
    throw Error(path, "has a focal length that is not positive", "give px");
  const bool has_size = camera.width > 0 && camera.height > 0;
  if (has_size && !(camera.cx > 0 && camera.cy > 0 && camera.cx < camera.width && camera.cy < camera.height))
    throw Error(path,
                fmt::format("has its principal point ({:.0f}, {:.0f}) outside the picture of {} x {} px",
                            camera.cx, camera.cy, camera.width, camera.height),
                "give the camera of this picture size, not cropped or scaled");
  if (has_size && !invertible_over_image(camera))
    throw Error(path, "has a distortion that folds over inside the image",
                "calibrate with a leaner lens model");
  return camera;
}

/// ROS' region of interest and binning: size and matrix are the whole sensor's, the pictures hold the region,
/// one pixel for a block of the sensor's. Pixel (0, 0) is a centre: a block's centre lies between its pixels.
Camera of_region(const YamlNode& root, Camera camera, const YamlPlace& place) {
  const std::string what_to_do = "give what the camera says of the pictures that you use";
  const int across = std::max(1, number(find(root, {"binning_x"}), place)),
            down = std::max(1, number(find(root, {"binning_y"}), place));
  if (const YamlNode* roi = find(root, {"roi"})) {
    const auto of = [&](std::string_view key) { return number(find(*roi, {key}), place.child("roi")); };
    const int x = of("x_offset"), y = of("y_offset"), width = of("width"), height = of("height");
    if (width != 0 || height != 0) {
      if (x < 0 || y < 0 || width <= 0 || height <= 0 || x > camera.width - width ||
          y > camera.height - height)
        throw Error(place.file + ": roi", "does not lie in the picture of the whole sensor", what_to_do);
      camera.cx -= x, camera.cy -= y;
      camera.width = width, camera.height = height;
    }
  }
  if (across > camera.width || down > camera.height) {
    if (across > 1 || down > 1) throw Error(place.file + ": binning_x", "leaves no picture", what_to_do);
    return camera;
  }
  camera.fx /= across, camera.fy /= down;
  camera.cx = (camera.cx + 0.5) / across - 0.5, camera.cy = (camera.cy + 0.5) / down - 0.5;
  camera.width /= across, camera.height /= down;
  return camera;
}

}  // namespace

Camera read_camera_file(const std::string& path_and_name) {
  const auto hash = path_and_name.rfind('#');
  const std::string path = path_and_name.substr(0, hash);
  const std::string name = hash == std::string::npos ? "" : path_and_name.substr(hash + 1);
  const YamlPlace place{path, ""};
  const std::string text = read_file(path, kMaxBytes);
  if (text.find("<opencv_storage>") != std::string::npos)
    throw Error(path, "is OpenCV's XML", "save it as .yaml with cv::FileStorage");
  const YamlNode root = detail::parse_yaml(plain_yaml(text), place);
  if (find(root, {"format"}) && find(root, {"sensors"})) return rig_camera(path, name);
  if (find(root, {"camera_matrix", "cameraMatrix", "K", "k", "M1"}))
    return of_region(root, checked(matrix_camera(root, place), path), place);
  if (find(root, {"cam0"}) || (!name.empty() && find(root, {name})))
    return checked(kalibr_camera(root, name, place), path);
  throw Error(path, "is no camera file that lightstripe knows",
              "give OpenCV's FileStorage (YAML), ROS' camera_info, Kalibr's camchain or a rig.yaml");
}

}  // namespace lightstripe
