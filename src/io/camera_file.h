// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A camera's intrinsics as other tools write and read them.
#pragma once

#include <filesystem>
#include <string>

#include "core/camera.h"
#include "core/transform.h"

namespace lightstripe {

/// Reads OpenCV's FileStorage (YAML), ROS' camera_info, Kalibr's camchain (pinhole with radtan or none) or a
/// rig.yaml, told apart by their keys. Of files with several cameras "file.yaml#cam1" names one; without it
/// the first is taken. width and height are 0 where the file does not say. An Error names what is missing or
/// what the model here has no equal for.
Camera read_camera_file(const std::string& path_and_name);

/// OpenCV's FileStorage: image_width, image_height, camera_matrix, distortion_coefficients.
std::string opencv_camera_yaml(const Camera& camera);

/// ROS' camera_info (plumb_bob or rational_polynomial). An Error where the camera has prism or tilt terms.
std::string ros_camera_info_yaml(const Camera& camera, const std::string& name);

/// mrcal's cameramodel (LENSMODEL_PINHOLE, _OPENCV4, 5, 8 or 12); cam_from_reference in mm, written in
/// metres. An Error where the sensor is tilted.
std::string mrcal_cameramodel(const Camera& camera, const Rigid3& cam_from_reference);

}  // namespace lightstripe
