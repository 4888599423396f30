// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// record, live and reconstruct --follow by the command line, with files played like a camera.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
#include <thread>

#include "command_line.h"
#include "test_paths.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::vector<std::string> lines_in(const std::string& text) {
  std::vector<std::string> lines;
  std::stringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// The cells of one column of a table.
std::vector<std::string> column(const std::string& table, std::size_t wanted, const std::string& frame) {
  std::vector<std::string> cells;
  for (const auto& line : lines_in(table)) {
    std::stringstream in(line);
    std::string cell;
    std::vector<std::string> row;
    while (std::getline(in, cell, ',')) row.push_back(cell);
    if (row[0] == frame) cells.push_back(row[wanted]);
  }
  return cells;
}

/// The numbers of a JSON line's array as they stand there, joined by commas.
std::string array_of(const std::string& json, const std::string& name) {
  const std::size_t at = json.find("\"" + name + "\":[");
  if (at == std::string::npos) return "";
  const std::size_t begin = at + name.size() + 4;
  return json.substr(begin, json.find(']', begin) - begin);
}

std::string joined(const std::vector<std::string>& cells) {
  std::string out;
  for (const auto& cell : cells) out += (out.empty() ? "" : ",") + cell;
  return out;
}

class Live : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    ASSERT_EQ(run_lightstripe("simulate testdata/one_sensor.yaml -o " + quoted(at("data"))).exit_code, 0);
    write_scan("scan.yaml", "data/scan/solo/*.png");
    ASSERT_EQ(run_lightstripe("reconstruct " + quoted(at("scan.yaml")) + " -o " + quoted(at("whole.ply")) +
                              " --profiles " + quoted(at("whole.csv")))
                  .exit_code,
              0);
  }
  static void TearDownTestSuite() { delete folder_; }
  static fs::path at(const std::string& name) { return *folder_ / name; }
  static std::string pictures() { return quoted(at("data/scan/solo")); }
  static void write_scan(const std::string& name, const std::string& frames,
                         const std::string& travel = "{step: 2}") {
    write_text(at(name),
               "rig: data/truth/rig.yaml\nframes: {solo: '" + frames + "'}\ntravel: " + travel + "\n");
  }
  static constexpr int kFrames = 6;  // of testdata/one_sensor.yaml

 private:
  static TemporaryFolder* folder_;
};
TemporaryFolder* Live::folder_ = nullptr;

TEST_F(Live, ARecordingGivesTheBytesOfItsSource) {
  const auto recorded =
      run_lightstripe("record " + pictures() + " -o " + quoted(at("recorded")) + " --step-mm 2");
  ASSERT_EQ(recorded.exit_code, 0) << recorded.err;
  EXPECT_THAT(recorded.out, StartsWith("6 frames in "));
  EXPECT_EQ(lines_in(text_of(at("recorded/frames.csv"))).size(), kFrames + 1U);
  EXPECT_THAT(text_of(at("recorded/travel.csv")), HasSubstr("\n5,10\n"));
  EXPECT_THAT(text_of(at("recorded/record.yaml")), HasSubstr("whole: 6\n"));
  write_scan("of_recorded.yaml", "recorded/*.pgm", "{file: recorded/travel.csv}");
  const auto result =
      run_lightstripe("reconstruct " + quoted(at("of_recorded.yaml")) + " -o " + quoted(at("again.ply")));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(text_of(at("again.ply")) == text_of(at("whole.ply")));
  const auto second = run_lightstripe("record " + pictures() + " -o " + quoted(at("recorded")));
  EXPECT_EQ(second.exit_code, 1);
  EXPECT_THAT(second.err, HasSubstr("holds a recording already"));
}

TEST_F(Live, ARecordingInOneFileAndAPlainFolderGiveTheBytesOfTheirSource) {
  const auto recorded =
      run_lightstripe("record " + pictures() + " -o " + quoted(at("one.tif")) + " --step-mm 2");
  ASSERT_EQ(recorded.exit_code, 0) << recorded.err;
  EXPECT_THAT(text_of(at("one.frames.csv")), HasSubstr("\n5,one.tif#5,ok,"));
  EXPECT_THAT(text_of(at("one.record.yaml")), HasSubstr("whole: 6\n"));
  const auto second = run_lightstripe("record " + pictures() + " -o " + quoted(at("one.tif")));
  EXPECT_EQ(second.exit_code, 1);
  EXPECT_THAT(second.err, HasSubstr("is there already"));
  const auto foldered =
      run_lightstripe("record " + pictures() + " -o " + quoted(at("plain")) + " --step-mm 2");
  ASSERT_EQ(foldered.exit_code, 0) << foldered.err;
  write_scan("of_file.yaml", "one.tif", "{file: one.travel.csv}");
  write_scan("of_folder.yaml", "plain", "{file: plain/travel.csv}");  // its tables are no pictures
  for (const std::string scan : {"of_file", "of_folder"}) {
    const auto result =
        run_lightstripe("reconstruct " + quoted(at(scan + ".yaml")) + " -o " + quoted(at(scan + ".ply")));
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(text_of(at(scan + ".ply")) == text_of(at("whole.ply"))) << scan;
  }
}

TEST_F(Live, EachFrameIsOneLineWithThePointsOfTheReconstruction) {
  const auto live =
      run_lightstripe("live " + pictures() + " --rig " + quoted(at("data/truth/rig.yaml")) + " --step-mm 2");
  ASSERT_EQ(live.exit_code, 0) << live.err;
  const auto lines = lines_in(live.out);
  ASSERT_EQ(lines.size(), static_cast<std::size_t>(kFrames));
  const std::string table = text_of(at("whole.csv"));
  for (int i = 0; i < kFrames; ++i) {
    const std::string frame = std::to_string(i), &line = lines[static_cast<std::size_t>(i)];
    EXPECT_THAT(line, StartsWith("{\"frame\":" + frame + ",\"status\":\"ok\",\"time\":\"20"));
    EXPECT_THAT(line, HasSubstr(",\"travel\":" + std::to_string(2 * i) + ","));
    EXPECT_EQ(array_of(line, "u"), joined(column(table, 7, frame)));
    EXPECT_EQ(array_of(line, "v"), joined(column(table, 8, frame)));
    EXPECT_EQ(array_of(line, "sigma"), joined(column(table, 9, frame)));
    EXPECT_FALSE(array_of(line, "u").empty());
  }
  EXPECT_THAT(live.err, HasSubstr("6 frames, "));
  EXPECT_THAT(live.err, HasSubstr(" 0 lost, 0 incomplete, 0 late, "));
}

TEST_F(Live, ADamagedFrameIsALineToo) {
  fs::create_directories(at("damaged"));
  for (int i = 0; i < 3; ++i)
    fs::copy_file(at("data/scan/solo/0000.png"), at("damaged/" + std::to_string(i) + ".png"));
  fs::resize_file(at("damaged/1.png"), 1000);
  const auto live = run_lightstripe("live " + quoted(at("damaged")) + " --no-points --rig " +
                                    quoted(at("data/truth/rig.yaml")));
  ASSERT_EQ(live.exit_code, 0) << live.err;
  ASSERT_EQ(lines_in(live.out).size(), 3U);
  EXPECT_THAT(lines_in(live.out)[1], StartsWith("{\"frame\":1,\"status\":\"incomplete\","));
  EXPECT_THAT(lines_in(live.out)[1], HasSubstr("\"reason\":\""));
  EXPECT_THAT(lines_in(live.out)[2], HasSubstr("\"status\":\"ok\""));
}

TEST_F(Live, WhatCannotBeOpenedIsNamed) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"aravis:NO-SUCH-CAMERA", "error: aravis:NO-SUCH-CAMERA: "},
      {"v4l2:/dev/no_such_video", "error: /dev/no_such_video: cannot be opened as a camera or stream; "},
      {"'/no/such/folder/*.png?frame_rate=20'", "error: /no/such/folder: no such folder; "},
      {pictures() + "'?frame_rate=x'", "error: option frame_rate of the source: 'x' is no number; "},
      {pictures() + "'?exposure=3'", "error: option exposure of the source: is not known; use frame_rate"}};
  for (const auto& [source, message] : cases) {
    const auto result = run_lightstripe("record " + source + " -o " + quoted(at("nothing")));
    EXPECT_EQ(result.exit_code, 1) << source;
    EXPECT_THAT(result.err, StartsWith(message)) << source;
  }
}

TEST_F(Live, AFullDiskEndsTheRecordingAndLeavesNoHalfPicture) {
  // 100 blocks of 1024 bytes: a picture of 480 x 350 is larger. As on a full disk, write() fails.
  const auto result = run_shell("ulimit -f 100; " + std::string(LIGHTSTRIPE_COMMAND) + " record " +
                                pictures() + " -o " + quoted(at("full")));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("0000000.pgm: cannot be written"));
  std::vector<std::string> left;
  for (const auto& entry : fs::directory_iterator(at("full"))) left.push_back(entry.path().filename());
  EXPECT_THAT(left, ::testing::UnorderedElementsAre("frames.csv", "record.yaml"));
}

TEST_F(Live, CtrlCEndsARecordingCleanly) {
  const auto result = run_shell("timeout --signal=INT 1 " + std::string(LIGHTSTRIPE_COMMAND) + " record " +
                                quoted(at("data/scan/solo/*.png?frame_rate=2")) + " -o " +
                                quoted(at("stopped")) + " & wait $!");
  EXPECT_THAT(result.out, HasSubstr("of them whole -> ")) << result.err;
  const auto rows = lines_in(text_of(at("stopped/frames.csv"))).size() - 1;
  EXPECT_GE(rows, 1U);
  EXPECT_LT(rows, 6U);
  EXPECT_THAT(text_of(at("stopped/record.yaml")), HasSubstr("\nframes: " + std::to_string(rows) + "\n"));
}

TEST_F(Live, FollowingAGrowingRecordingGivesTheBytesOfOneRun) {
  write_scan("growing.yaml", "growing/*.pgm", "{file: growing/travel.csv}");
  std::atomic<bool> page_grew = false, over = false;
  const std::jthread watch([&] {  // the page while the scan still grows asks to be loaded again
    while (!over) {
      if (fs::exists(at("followed.html")) &&
          text_of(at("followed.html")).find("http-equiv=\"refresh\"") != std::string::npos)
        page_grew = true;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  });
  auto following = std::async(std::launch::async, [] {
    return run_lightstripe("reconstruct " + quoted(at("growing.yaml")) + " --follow --idle 30 -o " +
                           quoted(at("followed.ply")) + " --profiles " + quoted(at("followed.csv")) +
                           " --view " + quoted(at("followed.html")));
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(300));  // it begins before there is a folder
  const auto recorded = run_lightstripe("record " + quoted(at("data/scan/solo/*.png?frame_rate=4")) + " -o " +
                                        quoted(at("growing")) + " --step-mm 2");
  ASSERT_EQ(recorded.exit_code, 0) << recorded.err;
  const auto result = following.get();  // ends by record.yaml, not by --idle
  over = true;
  EXPECT_TRUE(page_grew);
  EXPECT_EQ(text_of(at("followed.html")).find("http-equiv=\"refresh\""), std::string::npos);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(text_of(at("followed.ply")) == text_of(at("whole.ply")));
  EXPECT_TRUE(text_of(at("followed.csv")) == text_of(at("whole.csv")));
}

TEST_F(Live, ACameraInAScanNeedsFollow) {
  write_scan("camera.yaml", "aravis:ANY");
  const auto result =
      run_lightstripe("reconstruct " + quoted(at("camera.yaml")) + " -o " + quoted(at("camera.ply")));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("frames.solo: is a camera; give --follow"));
}

}  // namespace
}  // namespace lightstripe
