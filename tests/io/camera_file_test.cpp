// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Cameras of other tools, in texts as those tools write them.
#include "io/camera_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core/persistence.hpp>

#include "core/error.h"
#include "io/atomic_file.h"
#include "temp_folder.h"

namespace lightstripe {
namespace {

using ::testing::HasSubstr;

const Camera kCamera{960, 700, 1640.25, 1641.5, 481.125, 349.75, {-0.1, 0.12, 4e-4, -3e-4, -0.05}};

class CameraFile : public ::testing::Test {
 protected:
  std::string written(const std::string& name, const std::string& text) {
    write_file(folder_ / name, text);
    return (folder_ / name).string();
  }
  std::string message_of(const std::string& path) {
    try {
      read_camera_file(path);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }
  TempFolder folder_;
};

void expect_same(const Camera& a, const Camera& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.fx, b.fx);
  EXPECT_EQ(a.fy, b.fy);
  EXPECT_EQ(a.cx, b.cx);
  EXPECT_EQ(a.cy, b.cy);
  EXPECT_EQ(a.distortion, b.distortion);
}

TEST_F(CameraFile, OpenCvReadsWhatWasWrittenForIt) {
  auto tilted = kCamera;
  tilted.distortion = {-0.1, 0.12, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.14, -0.01};
  for (const auto& camera : {kCamera, tilted}) {
    const auto path = written("cv.yaml", opencv_camera_yaml(camera));
    cv::FileStorage file(path, cv::FileStorage::READ);
    cv::Mat K, D;
    file["camera_matrix"] >> K;
    file["distortion_coefficients"] >> D;
    EXPECT_EQ(static_cast<int>(file["image_width"]), 960);
    ASSERT_EQ(K.size(), cv::Size(3, 3));
    EXPECT_EQ(K.at<double>(0, 0), camera.fx);
    EXPECT_EQ(K.at<double>(1, 2), camera.cy);
    for (int i = 0; i < D.cols; ++i)
      EXPECT_EQ(D.at<double>(i), camera.distortion[static_cast<std::size_t>(i)]);
    EXPECT_EQ(D.cols, camera.tilted() ? 14 : 5);
    expect_same(read_camera_file(path), camera);
  }
}

TEST_F(CameraFile, WhatOpenCvWritesIsRead) {
  const auto path = (folder_ / "by_opencv.yml").string();
  {
    cv::FileStorage file(path, cv::FileStorage::WRITE);
    file << "image_width" << 960 << "image_height" << 700;
    file << "camera_matrix"
         << (cv::Mat_<double>(3, 3) << kCamera.fx, 0, kCamera.cx, 0, kCamera.fy, kCamera.cy, 0, 0, 1);
    file << "distortion_coefficients" << (cv::Mat_<double>(5, 1) << -0.1, 0.12, 4e-4, -3e-4, -0.05);
  }
  expect_same(read_camera_file(path), kCamera);
}

TEST_F(CameraFile, CameraInfoGoesBothWays) {
  const std::string text = ros_camera_info_yaml(kCamera, "gauge");
  EXPECT_THAT(text, HasSubstr("distortion_model: plumb_bob"));
  EXPECT_THAT(text, HasSubstr("projection_matrix"));
  expect_same(read_camera_file(written("ros.yaml", text)), kCamera);
  auto rational = kCamera;
  rational.distortion[7] = 0.25;
  EXPECT_THAT(ros_camera_info_yaml(rational, "gauge"), HasSubstr("rational_polynomial"));
  expect_same(read_camera_file(written("ros8.yaml", ros_camera_info_yaml(rational, "gauge"))), rational);
}

TEST_F(CameraFile, WhatRos2EchoesIsReadWithItsBinningAndRegion) {
  const std::string echoed =
      "header:\n  frame_id: cam\nheight: 480\nwidth: 640\ndistortion_model: plumb_bob\n"
      "d:\n- -0.09\n- 0.11\n- 0.0007\n- -0.0005\n- -0.04\n"
      "k:\n- 1095.0\n- 0.0\n- 324.0\n- 0.0\n- 1094.0\n- 235.0\n- 0.0\n- 0.0\n- 1.0\n";
  const std::string whole =
      echoed +
      "binning_x: 0\nbinning_y: 0\nroi:\n  x_offset: 0\n  y_offset: 0\n  height: 0\n  width: 0\n---\n";
  expect_same(read_camera_file(written("echo.yaml", whole)),
              {640, 480, 1095, 1094, 324, 235, {-0.09, 0.11, 0.0007, -0.0005, -0.04}});
  const std::string part = echoed +
                           "binning_x: 2\nbinning_y: 2\nroi:\n  x_offset: 100\n  y_offset: 40\n"
                           "  height: 400\n  width: 500\n---\n";
  expect_same(read_camera_file(written("part.yaml", part)),
              {250, 200, 547.5, 547, 111.75, 97.25, {-0.09, 0.11, 0.0007, -0.0005, -0.04}});
  // The optical axis may lie outside the region.
  const std::string corner = echoed + "roi: {x_offset: 400, y_offset: 0, height: 480, width: 240}\n";
  expect_same(read_camera_file(written("corner.yaml", corner)),
              {240, 480, 1095, 1094, -76, 235, {-0.09, 0.11, 0.0007, -0.0005, -0.04}});
  EXPECT_THAT(message_of(written("out.yaml", echoed + "roi: {x_offset: 500, width: 200, height: 9}\n")),
              HasSubstr("out.yaml: roi: does not lie in the picture"));
  EXPECT_THAT(message_of(written("bins.yaml", echoed + "binning_x: 641\n")), HasSubstr("leaves no picture"));
  EXPECT_THAT(message_of(written("two.yaml", whole + "width: 1\n")),
              HasSubstr("more than one YAML document"));
}

TEST_F(CameraFile, CamchainsAreReadByCamera) {
  const auto path = written("chain.yaml",
                            "cam0:\n  camera_model: pinhole\n  intrinsics: [461.5, 460.25, 362.5, 246.0]\n"
                            "  distortion_model: radtan\n  distortion_coeffs: [-0.25, 0.06, 0.0008, 0.0001]\n"
                            "  rostopic: /cam0/image_raw\n  resolution: [752, 480]\n"
                            "cam1:\n  camera_model: pinhole\n  intrinsics: [400, 401, 300, 200]\n"
                            "  distortion_model: equidistant\n  distortion_coeffs: [0, 0, 0, 0]\n");
  const Camera camera = read_camera_file(path);
  EXPECT_EQ(camera.fx, 461.5);
  EXPECT_EQ(camera.cy, 246.0);
  EXPECT_EQ(camera.width, 752);
  EXPECT_EQ(camera.distortion[2], 0.0008);
  EXPECT_THAT(message_of(path + "#cam1"), HasSubstr("equidistant"));
  // Found by libFuzzer: a size beyond every int.
  const std::string cam =
      "cam0:\n  camera_model: pinhole\n  intrinsics: [461.5, 460.25, 362.5, 246.0]\n  resolution: ";
  for (const char* size : {"[7.6e123, 480]", "[752, -480]", "[752.5, 480]"})
    EXPECT_THAT(message_of(written("size.yaml", cam + size + "\n")), HasSubstr("no picture's")) << size;
  EXPECT_THAT(message_of(path + "#cam7"), HasSubstr("has no cam7"));
}

TEST_F(CameraFile, CameramodelsHoldTheIntrinsicsAndThePoseInMetres) {
  const Rigid3 pose{Eigen::Quaterniond(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitY())), {100, 0, -50}};
  const std::string text = mrcal_cameramodel(kCamera, pose);
  EXPECT_THAT(text, HasSubstr("'lensmodel':  'LENSMODEL_OPENCV5'"));
  EXPECT_THAT(text, HasSubstr("1640.25, 1641.5, 481.125, 349.75, -0.1, 0.12, 0.0004, -0.0003, -0.05"));
  EXPECT_THAT(text, HasSubstr("'imagersize': [ 960, 700 ]"));
  EXPECT_THAT(text, HasSubstr("0.1, 0, -0.05 ]"));
}

TEST_F(CameraFile, WhatAFormatCannotHoldIsRefused) {
  auto tilted = kCamera;
  tilted.distortion[12] = 0.1;
  EXPECT_THROW(ros_camera_info_yaml(tilted, "a"), Error);
  EXPECT_THROW(mrcal_cameramodel(tilted, {}), Error);
}

TEST_F(CameraFile, BrokenFilesAreNamed) {
  EXPECT_THAT(message_of((folder_ / "none.yaml").string()), HasSubstr("none.yaml"));
  EXPECT_THAT(message_of(written("a.yaml", "camera_matrix: {rows: 3, cols: 3, data: [1, 2]}\n")),
              HasSubstr("3 x 3"));
  EXPECT_THAT(message_of(written("b.yaml", "camera_matrix: {rows: 3, cols: 3, data: [0,0,0,0,0,0,0,0,1]}\n")),
              HasSubstr("focal length"));
  EXPECT_THAT(message_of(written("c.yaml", "hello: world\n")),
              HasSubstr("no camera file that lightstripe knows"));
  EXPECT_THAT(message_of(written("d.xml", "<?xml version=\"1.0\"?>\n<opencv_storage>\n")), HasSubstr("XML"));
  EXPECT_THAT(
      message_of(written("e.yaml", "distortion_model: equidistant\ncamera_matrix: [1,0,0,0,1,0,0,0,1]\n")),
      HasSubstr("equidistant"));
}

TEST_F(CameraFile, WhatIsNoPinholeCameraIsRefusedByName) {
  const auto camera = [&](const std::string& K, const std::string& more) {
    return message_of(
        written("f.yaml", "image_width: 640\nimage_height: 480\ncamera_matrix: {rows: 3, cols: 3, data: [" +
                              K + "]}\n" + more));
  };
  const std::string good = "1095, 0, 324, 0, 1094, 235, 0, 0, 1";
  EXPECT_EQ(camera(good, ""), "no error");
  EXPECT_THAT(camera("1095, 0, 0, 0, 1094, 0, 324, 235, 1", ""), HasSubstr("written by columns"));
  EXPECT_THAT(camera("1095, 2.5, 324, 0, 1094, 235, 0, 0, 1", ""), HasSubstr("skew (2.5 px)"));
  EXPECT_THAT(camera("1095, 0, 324, 0, 1094, 235, 0, 0, 2", ""), HasSubstr("last row"));
  EXPECT_THAT(camera("1095, 0, 924, 0, 1094, 235, 0, 0, 1", ""), HasSubstr("outside the picture"));
  EXPECT_THAT(camera(good, "fisheye_model: 1\n"), HasSubstr("fisheye"));
  EXPECT_THAT(
      camera(good, "distortion_coefficients: {rows: 4, cols: 1, data: [0.241, 0.159, 0.137, 0.083]}\n"),
      HasSubstr("look like a fisheye"));
  // A wide lens: the same p1 that is harmless in a narrow picture moves the corner by 19 px.
  const std::string wide = "285, 0, 320, 0, 285, 240, 0, 0, 1";
  const std::string small =
      "distortion_coefficients: {rows: 4, cols: 1, data: [-0.01, 0.02, -0.011, 0.003]}\n";
  EXPECT_THAT(camera(wide, small), HasSubstr("they move the picture's corner by 19 px"));
  EXPECT_EQ(camera(good, small), "no error");
}

}  // namespace
}  // namespace lightstripe
