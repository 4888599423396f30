// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Other boards and lasers than one checkerboard and one sheet, from pictures to points by the command line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/aruco/charuco.hpp>
#include <set>

#include "core/random.h"
#include "io/atomic_file.h"
#include "io/rig_file.h"
#include "reconstruct/cloud.h"
#include "rendered_session.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::board_pose;
using testing::BoardLook;
using testing::calibrate_in;
using ::testing::HasSubstr;
using testing::render_board;
using testing::RenderedSession;

double angle_deg(const Plane& a, const Plane& b) {
  return std::asin(a.normal.cross(b.normal).norm()) / kDegree;
}

// ---- ChArUco
// -------------------------------------------------------------------------------------------------

constexpr int kTexturePxPerMm = 8;

Target charuco() {
  Target target{TargetType::kCharuco, 8, 6, 12, 12};
  target.marker_mm = 8.5;
  target.dictionary = "DICT_5X5_100";
  return target;
}

/// The board as OpenCV draws it, black 50 and white 200, softened by half a pixel of the pictures below.
cv::Mat1f charuco_texture(const Target& target) {
  const auto board = cv::aruco::CharucoBoard::create(
      target.columns + 1, target.rows + 1, static_cast<float>(target.pitch_x),
      static_cast<float>(target.marker_mm), cv::aruco::getPredefinedDictionary(cv::aruco::DICT_5X5_100));
  const int side = static_cast<int>(target.pitch_x) * kTexturePxPerMm;
  cv::Mat flat;
  board->draw(cv::Size((target.columns + 1) * side, (target.rows + 1) * side), flat, 0, 1);
  cv::Mat1f texture;
  flat.convertTo(texture, CV_32F, 150.0 / 255, 50);
  cv::GaussianBlur(texture, texture, {}, 2);
  return texture;
}

/// Pixel from board (mm, origin at the first inner corner) for a camera without distortion.
cv::Matx33d pixel_from_board(const Camera& camera, const Rigid3& cam_from_board) {
  const Eigen::Matrix3d R = cam_from_board.rotation.toRotationMatrix();
  const Vector3d t = cam_from_board.translation;
  const cv::Matx33d K(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  return K * cv::Matx33d(R(0, 0), R(0, 1), t.x(), R(1, 0), R(1, 1), t.y(), R(2, 0), R(2, 1), t.z());
}

/// The board before a dim room; `laser` adds its line where it is given.
Image8 charuco_picture(const Camera& camera, const Target& target, const cv::Mat1f& texture,
                       const Rigid3& cam_from_board, std::uint64_t seed, const Plane* laser) {
  const cv::Matx33d pixel_from_mm = pixel_from_board(camera, cam_from_board);
  const double first = 0.5 / kTexturePxPerMm - target.pitch_x;  // mm, the texture's first pixel
  const cv::Matx33d mm_from_texture(1.0 / kTexturePxPerMm, 0, first, 0, 1.0 / kTexturePxPerMm, first, 0, 0,
                                    1);
  cv::Mat1f picture;
  cv::warpPerspective(texture, picture, pixel_from_mm * mm_from_texture, {camera.width, camera.height},
                      cv::INTER_LINEAR, cv::BORDER_CONSTANT, 30);
  const cv::Matx33d mm_from_pixel = pixel_from_mm.inv();
  Image8 image(camera.width, camera.height);
  Random random(seed);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const cv::Vec3d mm = mm_from_pixel * cv::Vec3d(x, y, 1);
      const Vector3d place(mm[0] / mm[2], mm[1] / mm[2], 0);
      const double d = laser ? laser->signed_distance(cam_from_board * place) / 0.4 : 1e3;
      const double grey = picture(y, x) * (laser ? 0.4 : 1.0) + 0.7 * picture(y, x) * std::exp(-0.5 * d * d);
      image(x, y) =
          static_cast<std::uint8_t>(std::clamp(std::lround(grey + 1.5 * random.gaussian()), 0L, 255L));
    }
  }
  return image;
}

TEST(CharucoSession, IsCalibratedFromPartialViewsToo) {
  const TemporaryFolder folder;
  const Camera camera{640, 480, 1400, 1396, 326, 236, {}};
  const Plane laser = RenderedSession::laser_at(0);
  const Target target = charuco();
  const cv::Mat1f texture = charuco_texture(target);
  auto poses = testing::well_spread_poses(target);
  for (const double side : {-1.0, 1.0})  // a good third of the board beyond the picture's edge
    poses.push_back(board_pose(target, {95 * side, 12 * side, 505}, 24 * side, 15, 10));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto name = fmt::format("{}.png", i);
    write_image(folder / "solo/board/" / name,
                charuco_picture(camera, target, texture, poses[i], 2 * i, nullptr));
    write_image(folder / "solo/laser/" / name,
                charuco_picture(camera, target, texture, poses[i], 2 * i + 1, &laser));
  }
  write_text(
      folder / "session.yaml",
      "target: {type: charuco, inner_corners: [8, 6], square: 12, marker: 8.5, dictionary: DICT_5X5_100}\n"
      "sensors: [{name: solo, board: solo/board/*.png, laser: solo/laser/*.png}]\n"
      "calibration: {lens: pinhole, board_warp: true}\n");
  const auto result = calibrate_in(folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("boards: found in 10 of 10 images"));
  const Rig rig = read_rig(folder / "rig.yaml");
  const auto& sigma = rig.quality.sigma;
  EXPECT_NEAR(rig.sensors[0].camera.fx, camera.fx, 4 * sigma.at("solo.camera.fx"));
  EXPECT_LT(sigma.at("solo.camera.fx"), 0.005 * camera.fx);
  EXPECT_LT(angle_deg(rig.sensors[0].laser_planes[0], laser), 4 * sigma.at("solo.laser_planes.0.normal_deg"));
  EXPECT_LT(sigma.at("solo.laser_planes.0.normal_deg"), 0.3);
}

// ---- several laser planes
// ----------------------------------------------------------------------------------------

/// The sensor calibrated by a session of its own before plates that it then scans.
class SeveralLines : public ::testing::Test {
 protected:
  void calibrate(const std::vector<Plane>& lasers) {
    session_.lasers = lasers;
    session_.poses = testing::well_spread_poses(session_.target);
    write_pictures(session_, folder_.path(), "solo");
    write_session(session_, folder_.path(), {"solo"});
    const auto result = calibrate_in(folder_.path());
    ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
    rig_ = read_rig(folder_ / "rig.yaml");
  }

  /// A white plate of that height and width (mm), lit by all lasers; frame 0 of the scan.
  void picture_of_plate(const Rigid3& pose, double width_mm, double height_mm) {
    const Target plate{TargetType::kCheckerboard, 3, 3, width_mm / 4, height_mm / 4};
    const testing::BoardLook white = testing::lit_plate(20, 170);
    const Rigid3 middle{pose.rotation, pose * Vector3d(-width_mm / 4, -height_mm / 4, 0)};
    write_image(folder_ / "scan/0.png",
                render_board(session_.camera, plate, middle, white, 77, session_.lasers));
    write_text(folder_ / "scan.yaml", "rig: rig.yaml\nframes: {solo: scan/*.png}\ntravel: {step: 1}\n");
  }

  CommandResult reconstruct() const {
    return run_lightstripe("reconstruct " + quoted(folder_ / "scan.yaml") + " -o " +
                           quoted(folder_ / "cloud.ply"));
  }

  /// Root mean square and largest distance of the cloud's points from the plate, mm.
  std::array<double, 2> distances_from(const Rigid3& pose) const {
    double sum = 0, largest = 0;
    const auto cloud = read_cloud(folder_ / "cloud.ply");
    const Rigid3 plate_from_rig = pose.inverse() * rig_.sensors[0].rig_from_camera.inverse();
    for (const auto& p : cloud) {
      const double distance = std::abs((plate_from_rig * Vector3d(p.x, p.y, p.z)).z());
      sum += distance * distance;
      largest = std::max(largest, distance);
    }
    return {std::sqrt(sum / static_cast<double>(cloud.size())), largest};
  }

  RenderedSession session_;
  TemporaryFolder folder_;
  Rig rig_;
};

/// The middle of the plate before the camera.
Rigid3 plate_at(double z, double tilt_x_deg, double tilt_y_deg) {
  const Eigen::Quaterniond q = Eigen::AngleAxisd(tilt_x_deg * kDegree, Vector3d::UnitX()) *
                               Eigen::AngleAxisd(tilt_y_deg * kDegree, Vector3d::UnitY());
  return {q, {0, 0, z}};
}

class FiveLines : public SeveralLines {
 protected:
  void SetUp() override {
    std::vector<Plane> lasers;
    for (const double shift : {-16.0, -8.0, 0.0, 8.0, 16.0})
      lasers.push_back(RenderedSession::laser_at(shift));
    calibrate(lasers);
  }
};

TEST_F(FiveLines, EachGetsItsOwnPlane) {
  ASSERT_EQ(rig_.sensors[0].laser_planes.size(), 5u);
  const Rigid3 pose = plate_at(502, 12, -8);
  picture_of_plate(pose, 120, 110);
  const auto result = reconstruct();
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::set<int> lines;
  for (const auto& p : read_cloud(folder_ / "cloud.ply")) lines.insert(p.line);
  EXPECT_EQ(lines.size(), 5u);
  // A line taken for its neighbour's lies 12 mm off in depth; the calibration itself errs by its own sigma.
  const auto [rms, largest] = distances_from(pose);
  EXPECT_LT(rms, 4 * rig_.quality.section_absolute_sigma_mm);
  EXPECT_LT(largest, 4 * rig_.quality.section_absolute_sigma_mm + 0.5);
}

TEST_F(FiveLines, OneLineThatMayBeSeveralPlanesIsDroppedAndCounted) {
  picture_of_plate(plate_at(500, 0, 0), 60, 6);  // one line only crosses it
  const auto result = reconstruct();
  EXPECT_EQ(result.exit_code, 3) << result.out;
  EXPECT_THAT(result.err, HasSubstr("stripe points have no certain laser plane"));
}

/// Of each pixel the brighter one.
Image8 brighter(const Image8& a, const Image8& b) {
  Image8 out = a;
  for (std::size_t i = 0; i < out.pixels.size(); ++i) out.pixels[i] = std::max(a.pixels[i], b.pixels[i]);
  return out;
}

class ThreeLines : public SeveralLines {
 protected:
  /// Sheets 14 mm apart. The head stands where the boards were, the foot at both sides of it behind them.
  void SetUp() override {
    session_.calibration += ", range_near_mm: 440, range_far_mm: 560";
    calibrate({RenderedSession::laser_at(-14), RenderedSession::laser_at(0), RenderedSession::laser_at(14)});
    ASSERT_EQ(rig_.sensors[0].laser_planes.size(), 3u);
    ASSERT_LT(rig_.sensors[0].depth_range_mm[1] + 20, kFoot_mm);
  }
  static constexpr double kHead_mm = 490, kFoot_mm = 600;

  Image8 plate(double x, double z, double width_mm, double height_mm) const {
    const Target target{TargetType::kCheckerboard, 3, 3, width_mm / 4, height_mm / 4};
    const testing::BoardLook white = testing::lit_plate(10, 180);
    return render_board(session_.camera, target,
                        {Eigen::Quaterniond::Identity(), {x - width_mm / 4, -height_mm / 4, z}}, white, 5,
                        session_.lasers);
  }
  void write_scan(const Image8& picture) {
    write_image(folder_ / "scan/0.png", picture);
    write_text(folder_ / "scan.yaml", "rig: rig.yaml\nframes: {solo: scan/*.png}\ntravel: {step: 1}\n");
  }
  /// Points of the cloud within 3 mm of a wall at that depth.
  std::ptrdiff_t points_at(double z) const {
    const auto cloud = read_cloud(folder_ / "cloud.ply");
    const Rigid3 camera_from_rig = rig_.sensors[0].rig_from_camera.inverse();
    return std::count_if(cloud.begin(), cloud.end(), [&](const CloudPoint& p) {
      return std::abs((camera_from_rig * Vector3d(p.x, p.y, p.z)).z() - z) < 3;
    });
  }
};

TEST_F(ThreeLines, TheHeadIsKeptWhereTheFootLiesBeyondTheBoards) {
  write_scan(brighter(plate(0, kHead_mm, 50, 160),
                      brighter(plate(-70, kFoot_mm, 50, 260), plate(70, kFoot_mm, 50, 260))));
  const auto result = reconstruct();
  ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
  const auto cloud = read_cloud(folder_ / "cloud.ply");
  EXPECT_GT(cloud.size(), 150u);  // three lines of 84 px
  EXPECT_EQ(points_at(kHead_mm), static_cast<std::ptrdiff_t>(cloud.size()));
  EXPECT_THAT(result.err, HasSubstr("may lie outside its depth_range"));
  // The range that the message names keeps the foot as well.
  const auto range = result.err.find("depth_range: [");
  ASSERT_NE(range, std::string::npos) << result.err;
  double near = 0, far = 0;
  ASSERT_EQ(std::sscanf(result.err.c_str() + range, "depth_range: [%lf, %lf]", &near, &far), 2);
  Rig wider = rig_;
  wider.sensors[0].depth_range_mm = {near, far};
  write_file(folder_ / "rig.yaml", rig_to_yaml(wider));
  const auto again = reconstruct();
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_GT(points_at(kFoot_mm), 250);
  EXPECT_EQ(points_at(kFoot_mm) + points_at(kHead_mm),
            static_cast<std::ptrdiff_t>(read_cloud(folder_ / "cloud.ply").size()));
}

TEST_F(ThreeLines, AloneTheFootIsNotCalledNoStripe) {
  write_scan(plate(0, kFoot_mm, 60, 260));
  const auto result = reconstruct();
  EXPECT_EQ(result.exit_code, 3) << result.out;
  EXPECT_THAT(result.err, HasSubstr("lines were seen in 1 frame"));
  EXPECT_THAT(result.err, HasSubstr("may lie outside its depth_range"));
}

TEST_F(SeveralLines, CrossedOnesAreToldApart) {
  calibrate({RenderedSession::laser_at(0, -30), RenderedSession::laser_at(0, 30)});
  ASSERT_EQ(rig_.sensors[0].laser_planes.size(), 2u);
  const Rigid3 pose = plate_at(502, 12, -8);
  picture_of_plate(pose, 120, 110);
  const auto result = reconstruct();
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_GT(read_cloud(folder_ / "cloud.ply").size(), 100u);
  const auto [rms, largest] = distances_from(pose);
  EXPECT_LT(rms, 4 * rig_.quality.section_absolute_sigma_mm);
  EXPECT_LT(largest, 4 * rig_.quality.section_absolute_sigma_mm + 0.5);
}

}  // namespace
}  // namespace lightstripe
