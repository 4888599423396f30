// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The whole chain by the command line: a small simulated rig, calibrated and scanned, and what goes wrong in
// between.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "command_line.h"
#include "io/rig_file.h"
#include "reconstruct/cloud.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class Cli : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    const auto result = run_lightstripe("simulate testdata/one_sensor.yaml -o " + quoted(data()));
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto calibrated = run_lightstripe("calibrate " + quoted(data() / "calibration.yaml") + " -o " +
                                            quoted(data() / "rig.yaml"));
    ASSERT_EQ(calibrated.exit_code, 0) << calibrated.out << calibrated.err;
  }
  static void TearDownTestSuite() { delete folder_; }
  static fs::path data() { return *folder_ / "data"; }
  static std::string some_frame() { return quoted(data() / "scan/solo/0003.png"); }

  /// One line on stderr that begins as the contract says.
  static void expect_error(const CommandResult& result, int exit_code, const std::string& part) {
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_THAT(result.err, StartsWith(exit_code == 3 ? "not usable: " : "error: "));
    EXPECT_THAT(result.err, HasSubstr(part));
  }

  TemporaryFolder out_;

 private:
  static TemporaryFolder* folder_;
};
TemporaryFolder* Cli::folder_ = nullptr;

TEST(Program, StartsWithoutOpencvsCodecs) {
  // They stand on 200 shared libraries: half of the program's start. Who calls them goes through
  // io/opencv_codecs.h.
  const auto needed = run_shell("readelf -d " + std::string(LIGHTSTRIPE_COMMAND));
  ASSERT_EQ(needed.exit_code, 0) << needed.err;
  EXPECT_THAT(needed.out, HasSubstr("libopencv_core"));
  for (const char* codecs : {"imgcodecs", "videoio", "highgui"})
    EXPECT_THAT(needed.out, Not(HasSubstr(std::string("libopencv_") + codecs)));
}

TEST_F(Cli, CalibratedRigIsCloseToTheTrueOne) {
  const Rig rig = read_rig(data() / "rig.yaml"), truth = read_rig(data() / "truth/rig.yaml");
  ASSERT_EQ(rig.sensors.size(), 1U);
  // 9 small poses at half the resolution of the figure scene (0.08 degrees there): four times its budget.
  const double angle = std::acos(
      std::min(1.0, rig.sensors[0].laser_planes[0].normal.dot(truth.sensors[0].laser_planes[0].normal)));
  EXPECT_LT(angle * 180 / M_PI, 0.32);
  EXPECT_NEAR(rig.sensors[0].camera.fx / truth.sensors[0].camera.fx, 1.0, 0.01);
}

TEST_F(Cli, ReconstructWritesCloudProfilesAndPreview) {
  const auto result = run_lightstripe(
      "reconstruct " + quoted(data() / "scan.yaml") + " -o " + quoted(out_ / "cloud.ply") + " --profiles " +
      quoted(out_ / "profiles.csv") + " --preview " + quoted(out_ / "cloud.png"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto cloud = read_cloud(out_ / "cloud.ply");
  const std::string rows = text_of(out_ / "profiles.csv");
  EXPECT_GT(cloud.size(), 6U * 100U);
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), static_cast<long>(cloud.size()) + 1);
  EXPECT_THAT(rows, StartsWith("frame,travel,sensor,line,x,y,z,u,v,sigma\n0,"));
  EXPECT_GT(fs::file_size(out_ / "cloud.png"), 1000U);
  EXPECT_THAT(text_of(out_ / "cloud.ply.run.yaml"), HasSubstr("scan.yaml"));
}

TEST_F(Cli, TheNumberOfThreadsDoesNotChangeABit) {
  for (const std::string threads : {"1", "3"}) {
    const auto name = out_ / ("cloud" + threads + ".ply");
    ASSERT_EQ(run_lightstripe("reconstruct " + quoted(data() / "scan.yaml") + " --threads " + threads +
                              " -o " + quoted(name))
                  .exit_code,
              0);
    ASSERT_EQ(run_lightstripe("calibrate " + quoted(data() / "calibration.yaml") + " --threads " + threads +
                              " -o " + quoted(out_ / ("rig" + threads + ".yaml")))
                  .exit_code,
              0);
  }
  EXPECT_EQ(text_of(out_ / "cloud1.ply"), text_of(out_ / "cloud3.ply"));
  EXPECT_EQ(text_of(out_ / "rig1.yaml"), text_of(out_ / "rig3.yaml"));
}

TEST_F(Cli, ExtractWritesTableAndOverlay) {
  const auto result = run_lightstripe("extract " + some_frame() + " -o " + quoted(out_ / "stripes.csv") +
                                      " --overlay " + quoted(out_ / "overlay"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string rows = text_of(out_ / "stripes.csv");
  EXPECT_THAT(rows, StartsWith("image,line,x,y,normal_x,normal_y,width,strength,sigma_px,flags\n" +
                               (data() / "scan/solo/0003.png").string() + ",0,"));
  EXPECT_TRUE(fs::exists(out_ / "overlay/0003.png"));
}

TEST_F(Cli, EveryMethodOfTheContractFindsTheStripe) {
  for (const std::string method : {"direction-guided", "steger", "zhou-roi", "centroid"}) {
    const auto result =
        run_lightstripe("extract " + some_frame() + " --method " + method + " -o " + quoted(out_ / "s.csv"));
    EXPECT_EQ(result.exit_code, 0) << method << result.err;
  }
}

TEST_F(Cli, FilesOnStandardOutputOnlyWhenNotQuiet) {
  const auto result = run_lightstripe("extract --quiet " + some_frame() + " -o " + quoted(out_ / "s.csv"));
  EXPECT_EQ(result.out + result.err, "");
}

TEST_F(Cli, VerifyMeasuresTheBoardsAndPasses) {
  const auto result = run_lightstripe("verify " + quoted(data() / "calibration.yaml") + " --rig " +
                                      quoted(data() / "rig.yaml") + " -o " + quoted(out_ / "verify.csv") +
                                      " --max-plane-rms-mm 1");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("solo: stripe off the board"));
  EXPECT_THAT(result.out, HasSubstr("passed"));
  const std::string rows = text_of(out_ / "verify.csv");
  EXPECT_THAT(
      rows,
      StartsWith(
          "pose,sensor,other,laser_plane,corners,corner_rms_px,stripe_points,plane_mean_mm,plane_rms_mm,"
          "plane_max_mm,length_mm,length_error_mm,gap_mm,centre_gap_mm\n"));
  EXPECT_GE(std::count(rows.begin(), rows.end(), '\n'), 9);
}

TEST_F(Cli, VerifyFailsBeyondALimitAndSaysWhich) {
  const auto result = run_lightstripe("verify " + quoted(data() / "calibration.yaml") + " --rig " +
                                      quoted(data() / "rig.yaml") + " -o " + quoted(out_ / "verify.csv") +
                                      " --max-plane-rms-mm 0.000001");
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, HasSubstr("not usable: solo: stripe off the board's plane: "));
  EXPECT_TRUE(fs::exists(out_ / "verify.csv"));
}

TEST_F(Cli, VerifyNamesASensorThatTheRigHasNot) {
  std::string text = text_of(data() / "rig.yaml");
  const auto at = text.find("name: solo");
  ASSERT_NE(at, std::string::npos);
  write_text(out_ / "rig.yaml", text.replace(at, 10, "name: duo"));
  const auto result = run_lightstripe("verify --quiet " + quoted(data() / "calibration.yaml") + " --rig " +
                                      quoted(out_ / "rig.yaml") + " -o " + quoted(out_ / "verify.csv"));
  expect_error(result, 1, "has no sensor solo");
}

/// A headless Chromium's view of the page after its scripts ran, or nothing where there is none.
std::optional<std::string> rendered(const fs::path& page) {
  if (std::system("command -v chromium >/dev/null 2>&1") != 0) return std::nullopt;  // NOLINT(cert-env33-c)
  const TemporaryFolder folder;
  const std::string command =
      "timeout 60 chromium --headless --no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader "
      "--virtual-time-budget=15000 --user-data-dir=" +
      quoted(folder / "profile") + " --dump-dom " + quoted(fs::path("file://" + page.string())) + " >" +
      quoted(folder / "dom") + " 2>/dev/null";
  if (std::system(command.c_str()) != 0) return std::nullopt;  // NOLINT(cert-env33-c)
  return text_of(folder / "dom");
}

TEST_F(Cli, CalibrationReportOpensOfflineInABrowser) {
  const auto result = run_lightstripe(
      "calibrate " + quoted(data() / "calibration.yaml") + " -o " + quoted(out_ / "rig.yaml") + " --report " +
      quoted(out_ / "calibration.html") + " --cameras " + quoted(out_ / "cameras"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(fs::exists(out_ / "cameras/solo.opencv.yaml"));
  EXPECT_TRUE(fs::exists(out_ / "cameras/solo.ros.yaml"));
  EXPECT_TRUE(fs::exists(out_ / "cameras/solo.cameramodel"));
  const std::string page = text_of(out_ / "calibration.html");
  for (const std::string outside : {"src=\"http", "href=\"http", "@import"})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  const auto dom = rendered(out_ / "calibration.html");
  if (!dom) GTEST_SKIP() << "no chromium here";
  EXPECT_THAT(*dom, HasSubstr("data-ready=\"yes\""));  // set by the last line of its script
  EXPECT_THAT(*dom, HasSubstr(">Usable"));
  EXPECT_GE(std::count(dom->begin(), dom->end(), '\n'), 1);
}

TEST_F(Cli, GivenCameraIsKept) {
  std::string text = text_of(data() / "calibration.yaml");
  const auto at = text.find("name: solo");
  ASSERT_NE(at, std::string::npos) << text;
  text.replace(at, 10, "name: solo, camera: \"truth/rig.yaml#solo\"");
  write_text(data() / "given.yaml", text);
  const auto result =
      run_lightstripe("calibrate " + quoted(data() / "given.yaml") + " -o " + quoted(out_ / "rig.yaml"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(read_rig(out_ / "rig.yaml").sensors[0].camera.fx,
            read_rig(data() / "truth/rig.yaml").sensors[0].camera.fx);
}

// ---- the world is wrong: exit code 1
// -----------------------------------------------------------------------------

TEST_F(Cli, MissingSessionIsNamed) {
  expect_error(run_lightstripe("calibrate " + quoted(out_ / "none.yaml")), 1, "none.yaml");
}

TEST_F(Cli, MissingImageFolderIsNamed) {
  write_text(out_ / "s.yaml",
             "target: {type: checkerboard, inner_corners: [11, 8], square: 10}\n"
             "sensors: [{name: solo, board: nowhere/*.png}]\n");
  expect_error(run_lightstripe("calibrate " + quoted(out_ / "s.yaml") + " -o " + quoted(out_ / "rig.yaml")),
               1, "nowhere");
  EXPECT_FALSE(fs::exists(out_ / "rig.yaml"));
}

TEST_F(Cli, UnknownKeyIsNamedWithItsLine) {
  std::string text = text_of(data() / "scan.yaml");
  write_text(out_ / "scan.yaml", text + "colour: red\n");
  const auto result =
      run_lightstripe("reconstruct " + quoted(out_ / "scan.yaml") + " -o " + quoted(out_ / "c.ply"));
  expect_error(result, 1, "colour");
  EXPECT_THAT(result.err, HasSubstr("line"));
}

TEST_F(Cli, UnknownExtractionOptionIsNamed) {
  write_text(out_ / "scan.yaml", "rig: " + (data() / "rig.yaml").string() + "\nframes: {solo: \"" +
                                     (data() / "scan/solo/*.png").string() +
                                     "\"}\nextraction: {stripe_widht: 5}\n");
  expect_error(run_lightstripe("reconstruct " + quoted(out_ / "scan.yaml") + " -o " + quoted(out_ / "c.ply")),
               1, "stripe_widht");
}

TEST_F(Cli, NotANumberInTheRigIsNamed) {
  std::string text = text_of(data() / "rig.yaml");
  const auto at = text.find("fx: ") + 4;
  text.replace(at, text.find(',', at) - at, ".nan");
  write_text(out_ / "rig.yaml", text);
  expect_error(run_lightstripe("reconstruct " + quoted(data() / "scan.yaml") + " --rig " +
                               quoted(out_ / "rig.yaml") + " -o " + quoted(out_ / "c.ply")),
               1, "fx");
}

TEST_F(Cli, TruncatedFrameIsSkippedAndNamedOrStrictlyEndsTheRunWithoutACloud) {
  fs::copy(data() / "scan", out_ / "scan", fs::copy_options::recursive);
  fs::resize_file(out_ / "scan/solo/0002.png", fs::file_size(out_ / "scan/solo/0002.png") / 2);
  write_text(out_ / "scan.yaml", "rig: " + (data() / "rig.yaml").string() +
                                     "\nframes: {solo: scan/solo/*.png}\ntravel: {step: 2}\n");
  const std::string command = "reconstruct " + quoted(out_ / "scan.yaml") + " -o " + quoted(out_ / "c.ply");
  expect_error(run_lightstripe(command + " --strict"), 1, "0002.png");
  for (const auto& entry : fs::directory_iterator(out_.path()))
    EXPECT_NE(entry.path().extension(), ".ply") << "left behind: " << entry.path();
  const auto tolerant = run_lightstripe(command);
  EXPECT_EQ(tolerant.exit_code, 0);
  EXPECT_THAT(tolerant.err, HasSubstr("warning: frame 2 skipped: "));
  EXPECT_THAT(tolerant.err, HasSubstr("0002.png"));
  EXPECT_THAT(text_of(out_ / "c.ply.run.yaml"), HasSubstr("pictures_skipped: 1"));
  for (const auto& point : read_cloud(out_ / "c.ply")) EXPECT_NE(point.frame, 2);
}

TEST_F(Cli, FrameOfAnotherSizeIsSkippedARecordingOfThemRefused) {
  fs::copy(data() / "scan", out_ / "scan", fs::copy_options::recursive);
  write_text(out_ / "scan/solo/0002.pgm", "P5\n4 3\n255\n123456789012");
  fs::remove(out_ / "scan/solo/0002.png");
  const std::string rig = "rig: " + (data() / "rig.yaml").string();
  write_text(out_ / "scan.yaml", rig + "\nframes: {solo: 'scan/solo/000?.p*'}\ntravel: {step: 2}\n");
  const std::string command = "reconstruct " + quoted(out_ / "scan.yaml") + " -o " + quoted(out_ / "c.ply");
  const auto tolerant = run_lightstripe(command);
  EXPECT_EQ(tolerant.exit_code, 0);
  EXPECT_THAT(tolerant.err, HasSubstr("frame 2: the picture has 4 x 3 px"));
  expect_error(run_lightstripe(command + " --strict"), 1, "frame 2");
  write_text(out_ / "scan.yaml", rig + "\nframes: {solo: 'scan/solo/*.pgm'}\ntravel: {step: 2}\n");
  expect_error(run_lightstripe(command), 1, "0002.pgm has 4 x 3 px");
}

TEST_F(Cli, RecordingWithoutOneReadablePictureIsAnError) {
  write_text(out_ / "scan/1.png", "");
  write_text(out_ / "scan/2.png", "no picture");
  write_text(out_ / "scan.yaml",
             "rig: " + (data() / "rig.yaml").string() + "\nframes: {solo: scan/*.png}\ntravel: {step: 2}\n");
  expect_error(run_lightstripe("reconstruct " + quoted(out_ / "scan.yaml") + " -o " + quoted(out_ / "c.ply")),
               1, "1.png: is empty");
}

TEST_F(Cli, EmptyScanFolderIsNamed) {
  fs::create_directories(out_ / "scan/solo");
  write_text(out_ / "scan.yaml", "rig: " + (data() / "rig.yaml").string() +
                                     "\nframes: {solo: scan/solo/*.png}\ntravel: {step: 2}\n");
  expect_error(run_lightstripe("reconstruct " + quoted(out_ / "scan.yaml") + " -o " + quoted(out_ / "c.ply")),
               1, "scan/solo");
}

TEST_F(Cli, UnwritableOutputIsNamed) {
  expect_error(run_lightstripe("extract " + some_frame() + " -o /proc/none/s.csv"), 1, "/proc/none");
}

// ---- done, but not usable: exit code 3
// ---------------------------------------------------------------------------

TEST_F(Cli, ScanWithoutStripesIsNotUsableAndWritesNothing) {
  const std::string black = "P5\n480 350\n255\n" + std::string(480 * 350, '\0');
  for (const std::string name : {"0.pgm", "1.pgm"}) write_text(out_ / "scan" / name, black);
  write_text(out_ / "scan.yaml",
             "rig: " + (data() / "rig.yaml").string() + "\nframes: {solo: scan/*.pgm}\ntravel: {step: 2}\n");
  const auto result =
      run_lightstripe("reconstruct " + quoted(out_ / "scan.yaml") + " -o " + quoted(out_ / "c.ply"));
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, HasSubstr("not usable: no stripe"));
  EXPECT_FALSE(fs::exists(out_ / "c.ply"));
}

TEST_F(Cli, WrongCornerCountIsNotUsableAndSaysSo) {
  std::string text = text_of(data() / "calibration.yaml");
  const auto at = text.find("inner_corners: [11, 8]");
  ASSERT_NE(at, std::string::npos) << text;
  text.replace(at, 22, "inner_corners: [10, 7]");
  write_text(data() / "wrong.yaml", text);
  const auto result =
      run_lightstripe("calibrate " + quoted(data() / "wrong.yaml") + " -o " + quoted(out_ / "rig.yaml"));
  EXPECT_EQ(result.exit_code, 3) << result.err;
  EXPECT_FALSE(fs::exists(out_ / "rig.yaml"));
}

// ---- wrong usage: exit code 2
// ------------------------------------------------------------------------------------

TEST_F(Cli, WrongUsageIsExitCode2) {
  for (const std::string arguments :
       {"", "frobnicate", "extract", "extract --method", "calibrate", "reconstruct --threads 0 x.yaml",
        "simulate testdata/one_sensor.yaml", "extract --frob x.png"})
    EXPECT_EQ(run_lightstripe(arguments).exit_code, 2) << arguments;
}

TEST_F(Cli, HelpIsExitCode0ForEveryCommand) {
  for (const std::string command : {"", "demo", "extract", "calibrate", "verify", "reconstruct", "simulate"})
    EXPECT_EQ(run_lightstripe(command + " --help").exit_code, 0) << command;
}

}  // namespace
}  // namespace lightstripe
