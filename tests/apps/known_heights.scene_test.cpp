// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A laser plane from pictures of blocks of known heights on a bed, as a user without many boards takes them.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "calib/adjust/board_surface.h"
#include "io/rig_file.h"
#include "rendered_session.h"

namespace lightstripe {
namespace {

using ::testing::HasSubstr;
using testing::render_board;
using testing::RenderedSession;

const std::vector<double> kHeights{2.5, 5, 10, 15, 20, 30, 40, 50, 65, 80};

/// Half a millimetre of bed a pixel would leave 0.04 mm.
RenderedSession bench() {
  RenderedSession session;
  session.camera = {960, 720, 1650, 1648, 484, 356, {-0.09, 0.1}};
  return session;
}
const RenderedSession kBench = bench();
const Rigid3 kBed = testing::board_pose(kBench.target, {0, 0, 540}, 8, 3, 2);

/// The bed with a block on it, as wide as two thirds of the bed; both are lit by the laser.
Image8 picture_of_block(double height_mm, std::uint64_t seed) {
  const Rigid3 top = raised(kBed, height_mm), board_from_cam = top.inverse();
  const auto look = testing::lit_plate(40, 140);
  Image8 picture = render_board(kBench.camera, kBench.target, kBed, look, seed, kBench.lasers);
  const Image8 block = render_board(kBench.camera, kBench.target, top, look, seed + 1, kBench.lasers);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const auto ray = unproject(kBench.camera, {1.0 * x, 1.0 * y});
      const Eigen::Vector3d direction = board_from_cam.rotation * *ray;
      const double s = -board_from_cam.translation.z() / direction.z();
      const double u = board_from_cam.translation.x() + s * direction.x();
      if (u > 20 && u < 90) picture(x, y) = block(x, y);
    }
  }
  return picture;
}

class KnownHeights : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    write_image(*folder_ / "bed.png", render_board(kBench.camera, kBench.target, kBed, kBench.look, 1));
    const auto& camera = kBench.camera;
    write_text(*folder_ / "camera.yaml",
               fmt::format("image_width: {}\nimage_height: {}\ncamera_matrix: {{rows: 3, cols: 3, data: [{}, "
                           "0, {}, 0, {}, {}, 0, 0, 1]}}\ndistortion_model: plumb_bob\n"
                           "distortion_coefficients: {{rows: 1, cols: 5, data: [-0.09, 0.1, 0, 0, 0]}}\n",
                           camera.width, camera.height, camera.fx, camera.cx, camera.fy, camera.cy));
    for (std::size_t i = 0; i < kHeights.size(); ++i)
      write_image(*folder_ / fmt::format("block{}.png", i), picture_of_block(kHeights[i], 10 + 2 * i));
    write_text(
        *folder_ / "session.yaml",
        "target: {type: checkerboard, inner_corners: [11, 8], square: 10}\nsensors:\n  - {name: bench, "
        "camera: camera.yaml, bed: bed.png, heights: heights.csv}\n");
  }
  static void TearDownTestSuite() { delete folder_; }
  /// Heights as the table gives them, for the pictures of kHeights.
  static CommandResult calibrate(const std::vector<double>& heights) {
    std::string table = "image,height_mm\n";
    for (std::size_t i = 0; i < kHeights.size(); ++i) table += fmt::format("block{}.png,{}\n", i, heights[i]);
    write_text(*folder_ / "heights.csv", table);
    return testing::calibrate_in(folder_->path());
  }
  static TemporaryFolder* folder_;
};
TemporaryFolder* KnownHeights::folder_ = nullptr;

TEST_F(KnownHeights, TenBlocksGiveHeightsToThreeHundredthsOfAMillimetre) {
  const CommandResult done = calibrate(kHeights);
  ASSERT_EQ(done.exit_code, 0) << done.err << done.out;
  EXPECT_THAT(done.out, HasSubstr("bench: 10 of 10 stripes lie in the laser plane"));
  const Plane found = read_rig(*folder_ / "rig.yaml", RigUse::kCameras).sensors.at(0).laser_planes.at(0);
  // Where the true sheet meets a plane of known height, the rig must measure that height.
  double sum = 0;
  int count = 0;
  for (const double height : kHeights) {
    const Rigid3 top = raised(kBed, height), board_from_cam = top.inverse();
    for (double x = -10; x <= 110; x += 10) {
      const Eigen::Vector3d from = top * Eigen::Vector3d(x, 0, 0);
      const Eigen::Vector3d along = top.rotation * Eigen::Vector3d::UnitY();
      const double step = -kBench.lasers[0].signed_distance(from) / kBench.lasers[0].normal.dot(along);
      const auto pixel = project(kBench.camera, from + step * along);
      ASSERT_TRUE(pixel);
      const auto measured = intersect(found, Eigen::Vector3d::Zero(), *unproject(kBench.camera, *pixel));
      ASSERT_TRUE(measured);
      const double error = (board_from_cam * *measured).z();
      sum += error * error;
      ++count;
    }
  }
  EXPECT_LT(std::sqrt(sum / count), 0.03);
}

TEST_F(KnownHeights, HeightsInAWrongOrderAreRefused) {
  // Shifted along the list they still rise with the true ones: most of them lie in one plane, a wrong one.
  for (const int shift : {1, 3, 9}) {
    std::vector<double> heights = kHeights;
    std::rotate(heights.begin(), heights.begin() + shift, heights.end());
    const CommandResult done = calibrate(heights);
    EXPECT_EQ(done.exit_code, 3) << shift << done.out;
    EXPECT_THAT(done.err, HasSubstr("heights.csv")) << shift;
  }
}

}  // namespace
}  // namespace lightstripe
