// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Sessions with pictures that are not what they should be, through the command line: exit code 3 and a
// sentence.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/rig_file.h"
#include "rendered_session.h"
#include "test_paths.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;
using testing::calibrate_in;
using ::testing::HasSubstr;
using testing::RenderedSession;

/// One good session, rendered once; each test arranges its pictures anew.
class WrongSessions : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    pictures_ = new TemporaryFolder;
    RenderedSession session;
    session.poses = testing::well_spread_poses(session.target);
    write_pictures(session, pictures_->path(), "solo");
  }
  static void TearDownTestSuite() { delete pictures_; }

  static fs::path board(int i) { return pictures_->path() / "solo/board" / fmt::format("{}.png", i); }
  static fs::path laser(int i) { return pictures_->path() / "solo/laser" / fmt::format("{}.png", i); }

  void put(const fs::path& from, const std::string& to) {
    fs::create_directories((folder_ / to).parent_path());
    fs::copy_file(from, folder_ / to, fs::copy_options::overwrite_existing);
  }

  /// Pairs b/<i>.png and l/<i>.png, where laser_of(i) gives the second picture.
  template <class F>
  void put_pairs(const F& laser_of) {
    for (int i = 0; i < kPoses; ++i) {
      put(board(i), fmt::format("b/{}.png", i));
      put(laser_of(i), fmt::format("l/{}.png", i));
    }
  }

  CommandResult calibrate(
      const std::string& sensor,
      const std::string& target = "{type: checkerboard, inner_corners: [11, 8], square: 10}") {
    write_text(folder_ / "session.yaml", "target: " + target + "\nsensors: [{name: solo, " + sensor +
                                             "}]\ncalibration: {lens: brown4}\n");
    return calibrate_in(folder_.path());
  }

  void expect_refused(const CommandResult& result, const std::string& what) {
    EXPECT_EQ(result.exit_code, 3) << result.out << result.err;
    EXPECT_THAT(result.err, HasSubstr(what));
    EXPECT_FALSE(fs::exists(folder_ / "rig.yaml"));
  }

  static constexpr int kPoses = 8;
  static inline TemporaryFolder* pictures_ = nullptr;
  TemporaryFolder folder_;
};

const std::string kPairs = "board: b/*.png, laser: l/*.png";

TEST_F(WrongSessions, AreNotTheGoodOne) {
  put_pairs(laser);
  const auto result = calibrate(kPairs);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("solo: 8 of 8 stripes lie in the laser plane"));
}

TEST_F(WrongSessions, NoLaserInAnyPicture) {
  put_pairs([](int i) { return board(i); });
  expect_refused(calibrate(kPairs), "no laser line on any board");
  expect_refused(calibrate("board: b/*.png"), "no laser line on any board");
}

TEST_F(WrongSessions, LaserPicturesOfTheNextPose) {
  put_pairs([](int i) { return laser((i + 1) % kPoses); });
  expect_refused(calibrate(kPairs),
                 "laser picture 0.png fits board picture 1.png: are the files shifted by 1?");
}

TEST_F(WrongSessions, LaserPicturesOfReversedPoses) {
  put_pairs([](int i) { return laser(kPoses - 1 - i); });
  expect_refused(calibrate(kPairs), "fits board picture 6.png: are the pairs mixed up?");
}

TEST_F(WrongSessions, SwappedFolders) {
  put_pairs(laser);
  expect_refused(calibrate("board: l/*.png, laser: b/*.png"), "swap the patterns of board and laser");
}

TEST_F(WrongSessions, SquaresInMetres) {
  put_pairs(laser);
  expect_refused(calibrate(kPairs, "{type: checkerboard, inner_corners: [11, 8], square: 0.01}"),
                 "did you give metres?");
}

TEST_F(WrongSessions, AnotherNumberOfCorners) {
  put_pairs(laser);
  expect_refused(calibrate(kPairs, "{type: checkerboard, inner_corners: [10, 8], square: 10}"),
                 "all pictures show 11 x 8 inner corners, the session says 10 x 8");
  expect_refused(calibrate(kPairs, "{type: checkerboard, inner_corners: [11, 9], square: 10}"),
                 "all pictures show 11 x 8 inner corners, the session says 11 x 9");
}

TEST_F(WrongSessions, BoardsForTheCameraAloneAreAskedForByName) {
  put_pairs(laser);
  const auto result = calibrate("board: b/*.png, laser: none");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(read_rig(folder_ / "rig.yaml", RigUse::kCameras).sensors[0].laser_planes.empty());
  write_text(folder_ / "scan.yaml", "rig: rig.yaml\nframes: {solo: l/*.png}\ntravel: {step: 1}\n");
  const auto scanned = run_lightstripe("reconstruct " + quoted(folder_ / "scan.yaml") + " -o " +
                                       quoted(folder_ / "cloud.ply"));
  EXPECT_EQ(scanned.exit_code, 1);
  EXPECT_THAT(scanned.err, HasSubstr("calibrated with `laser: none`"));
}

TEST_F(WrongSessions, GivenCamerasOfAnotherModelAreRefused) {
  const fs::path cases = fs::path(LIGHTSTRIPE_SOURCE_DIR) / "../shared/cases/files";
  if (!fs::exists(cases / "07-opencv-fisheye-camera")) GTEST_SKIP() << "no cases in " << cases;
  put_pairs(laser);
  for (const auto& [file, words] :
       {std::pair{"07-opencv-fisheye-camera/03_opencv_fisheye.yml", "fisheye"},
        {"08-matlab-transposed-K/40_matlab_transposed.yml", "written by columns"}}) {
    const auto result = calibrate(kPairs + ", camera: '" + fs::canonical(cases / file).string() + "'");
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err, HasSubstr(words));
  }
}

}  // namespace
}  // namespace lightstripe
