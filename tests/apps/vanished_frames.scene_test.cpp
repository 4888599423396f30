// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Frames that vanish, in every way that a recording loses them: they are named on stderr and in run.yaml, and
// with --strict they end the run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "command_line.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr int kFrames = 6;

class VanishedFrames : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    ASSERT_EQ(
        run_lightstripe("simulate testdata/one_sensor.yaml --quiet -o " + quoted(folder_->path())).exit_code,
        0);
  }
  static void TearDownTestSuite() { delete folder_; }
  static fs::path at(const std::string& name) { return *folder_ / name; }
  static fs::path picture(int i) { return at("scan/solo/000" + std::to_string(i) + ".png"); }

  /// travel.csv or poses.csv of the frames [first, end).
  static std::string table(int first, int end, bool poses = false) {
    std::string text = poses ? "frame,qw,qx,qy,qz,x,y,z\n" : "frame,travel_mm\n";
    for (int i = first; i < end; ++i)
      text +=
          std::to_string(i) + (poses ? ",1,0,0,0," : ",") + std::to_string(2 * i) + (poses ? ",0,0\n" : "\n");
    return text;
  }
  static void scan(const std::string& pictures, const std::string& travel) {
    write_text(at("scan.yaml"),
               "rig: truth/rig.yaml\nframes: {solo: '" + pictures + "'}\ntravel: " + travel + "\n");
  }
  static CommandResult reconstruct(const std::string& more) {
    return run_lightstripe("reconstruct " + quoted(at("scan.yaml")) + " -o " + quoted(at("c.ply")) + " " +
                           more);
  }
  /// The loss is said by `sentence` (and in run.yaml by `record`), and refused with --strict.
  static void expect_named(const std::string& sentence, const std::string& record,
                           const std::string& strict) {
    fs::remove(at("c.ply"));
    const auto plain = reconstruct("");
    EXPECT_EQ(plain.exit_code, 0) << plain.err;
    EXPECT_THAT(plain.err, HasSubstr(sentence));
    EXPECT_THAT(text_of(at("c.ply.run.yaml")), HasSubstr(record));
    fs::remove(at("c.ply"));
    const auto refused = reconstruct("--strict");
    EXPECT_EQ(refused.exit_code, 1) << refused.err;
    EXPECT_THAT(refused.err, HasSubstr("error: "));
    EXPECT_THAT(refused.err, HasSubstr(strict));
    EXPECT_FALSE(fs::exists(at("c.ply")));
  }
  static void expect_whole() {
    const auto result = reconstruct("--strict");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, Not(HasSubstr("warning")));
  }

  /// Pattern of a folder with these pictures only.
  static std::string pictures(std::initializer_list<int> frames) {
    fs::remove_all(at("part"));
    fs::create_directories(at("part"));
    for (const int i : frames) fs::copy_file(picture(i), at("part") / picture(i).filename());
    return "part/*.png";
  }
  static void write_video(const std::string& name) {
    cv::VideoWriter writer(at(name).string(), cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 25, {480, 350});
    for (int i = 0; i < kFrames; ++i) writer.write(cv::imread(picture(i).string()));
  }
  static void cut(const std::string& name, double share) {
    fs::resize_file(at(name),
                    static_cast<std::uintmax_t>(share * static_cast<double>(fs::file_size(at(name)))));
  }

 private:
  static TemporaryFolder* folder_;
};
TemporaryFolder* VanishedFrames::folder_ = nullptr;

TEST_F(VanishedFrames, ATableThatEndsBeforeThePicturesOrBeginsAfterThem) {
  for (const bool poses : {false, true}) {
    scan("scan/solo/*.png", poses ? "{poses: t.csv, of: rig}" : "{file: t.csv}");
    write_text(at("t.csv"), table(0, 4, poses));
    expect_named("2 frames have no position and are left out: 4 to 5", "without_position: 4 to 5",
                 "t.csv: says no position of the frames 4 to 5");
    write_text(at("t.csv"), table(2, 4, poses));
    expect_named("left out: 0 to 1, 4 to 5", "without_position: \"0 to 1, 4 to 5\"",
                 "the frames 0 to 1, 4 to 5");
    write_text(at("t.csv"), table(0, kFrames, poses));
    expect_whole();
  }
}

TEST_F(VanishedFrames, PicturesThatEndBeforeTheTableOrBeginAfterIt) {
  scan(pictures({2, 3, 4}), "{file: t.csv}");
  write_text(at("t.csv"), table(0, kFrames));
  expect_named("0 to 1, 5", "without_picture: \"0 to 1, 5\"",
               "t.csv: knows frames that have no picture: 0 to 1, 5");
}

TEST_F(VanishedFrames, APictureThatIsMissingInTheMiddle) {
  for (const std::string travel : {"{file: t.csv}", "{step: 2}"}) {
    write_text(at("t.csv"), table(0, kFrames));
    scan(pictures({0, 1, 2, 4, 5}), travel);
    expect_named("frame 3 skipped: solo, frame 3: its picture is missing", "frame: 3",
                 "frame 3: its picture");
  }
}

TEST_F(VanishedFrames, AThinnedFolderWithAStepIsSaid) {
  scan(pictures({0, 2, 4}), "{step: 2}");
  const auto result = reconstruct("");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err,
              HasSubstr("the pictures' numbers go in steps of 2: each picture is taken as one step"));
}

TEST_F(VanishedFrames, TimeStampsThatHaveNoPicture) {
  fs::create_directories(at("stamps"));
  std::string rows = "frame,travel_mm\n";
  for (int i = 0; i < kFrames; ++i) {
    const std::string stamp = std::to_string(1'700'000'000'000'000'000 + i * 33'333'337LL + i % 2);
    rows += stamp + "," + std::to_string(2 * i) + "\n";
    if (i != 3) fs::copy_file(picture(i), at("stamps/" + stamp + ".png"));
  }
  write_text(at("t.csv"), rows);
  scan("stamps/*.png", "{file: t.csv}");
  expect_named("1 of 6 time stamps have no picture, the first is 1700000000100000012", "1700000000100000012",
               "1 of 6 time stamps have no picture");
}

TEST_F(VanishedFrames, AVideoThatIsCutShort) {
  for (const std::string name : {"v.avi", "v.mp4"}) {
    write_video(name);
    if (!fs::exists(at(name))) continue;  // no such writer here
    scan(name, "{step: 2}");
    expect_whole();
  }
  cut("v.avi", 0.55);
  scan("v.avi", "{step: 2}");
  expect_named("v.avi holds 3 frames that can be read, its header says 6", "its header says 6",
               "v.avi holds 3 frames");
  EXPECT_THAT(reconstruct("").err, Not(HasSubstr("@ 0x"))) << "the decoder's own words";
}

TEST_F(VanishedFrames, AMultiPageTiffThatIsCutShort) {
  std::vector<cv::Mat> pages;
  for (int i = 0; i < kFrames; ++i) pages.push_back(cv::imread(picture(i).string(), cv::IMREAD_GRAYSCALE));
  cv::imwritemulti(at("p.tif").string(), pages);
  scan("p.tif", "{step: 2}");
  expect_whole();
  cut("p.tif", 0.55);
  const auto result = reconstruct("");
  EXPECT_TRUE(result.exit_code == 1 || result.err.find("warning") != std::string::npos) << result.err;
  EXPECT_EQ(reconstruct("--strict").exit_code, 1);
}

}  // namespace
}  // namespace lightstripe
