// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Files that are no settings, pictures or tables by far end the run soon and by name, and a signal at any
// time leaves nothing temporary behind, whatever the command.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <tuple>
#include <vector>

#include "command_line.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

std::string repeated(const std::string& text, std::size_t bytes) {
  std::string out;
  out.reserve(bytes + text.size());
  while (out.size() < bytes) out += text;
  return out;
}

constexpr std::size_t kBytes = 15'000'000;
// The slowest of these took 24 s before there was a limit; on a busy machine a run takes one.
constexpr double kSoonSeconds = 12;

TEST(HugeInputs, FifteenMegabytesOfYamlEndSoon) {
  const TemporaryFolder folder;
  const std::string too_many = "has more than 200000 values", too_long = "is longer than 262144 bytes";
  for (const auto& [text, sentence] : std::vector<std::pair<std::string, std::string>>{
           {"rig: a\nx:\n" + repeated(" - [1, 2, 3]\n", kBytes), too_many},
           {repeated("? a\n: b\n", kBytes), too_many},
           {"rig: [" + repeated("1, ", kBytes) + "1]\n", too_long},
           {repeated("{", kBytes), too_long},
           {"rig: \"" + repeated("\\n", kBytes) + "\"\n", too_long},
           {repeated("# x\n", kBytes), "is empty"}}) {
    write_text(folder / "s.yaml", text);
    const auto begin = std::chrono::steady_clock::now();
    const auto result =
        run_lightstripe("reconstruct " + quoted(folder / "s.yaml") + " -o " + quoted(folder / "c.ply"));
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    EXPECT_EQ(result.exit_code, 1) << text.substr(0, 20);
    EXPECT_THAT(result.err, HasSubstr(sentence)) << text.substr(0, 20);
    EXPECT_LT(took.count(), kSoonSeconds) << text.substr(0, 20);
  }
}

/// A little-endian TIFF of pages without a tag.
std::string empty_pages(std::uint32_t count) {
  std::string tiff("II*\0\x08\0\0\0", 8);
  for (std::uint32_t i = 0, next = 14; i < count; ++i, next += 6) {
    const std::uint32_t link = i + 1 < count ? next : 0;
    tiff += std::string(2, '\0');
    for (int shift = 0; shift < 32; shift += 8) tiff += static_cast<char>(link >> shift & 255);
  }
  return tiff;
}

TEST(HugeInputs, TwoHundredThousandEmptyPagesEndSoon) {
  const TemporaryFolder folder;
  write_text(folder / "p.tif", empty_pages(200000));
  for (const auto& [command, code, sentence] : std::vector<std::tuple<std::string, int, std::string>>{
           {"extract p.tif -o s.csv", 1, "p.tif: has no pixels"},
           {"record p.tif -o rec --seconds 1", 3, "no whole frame arrived"}}) {
    const auto begin = std::chrono::steady_clock::now();
    const auto result = run_shell("cd " + quoted(folder.path()) + " && " LIGHTSTRIPE_COMMAND " " + command);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    EXPECT_EQ(result.exit_code, code) << command;
    EXPECT_THAT(result.err, HasSubstr(sentence)) << command;
    EXPECT_LT(took.count(), kSoonSeconds) << command;
  }
}

TEST(HugeInputs, EndlessDevicesAreRefusedByEveryReader) {
  const TemporaryFolder folder;
  for (const std::string command :
       {"measure /dev/zero --kind rail -o m.csv", "calibrate /dev/zero -o r.yaml",
        "reconstruct /dev/zero -o c.ply", "extract /dev/zero -o s.csv", "view /dev/zero -o c.html",
        "merge /dev/zero -o c.csv", "simulate /dev/zero -o d", "verify /dev/zero --rig r.yaml",
        "conicity --wheel /dev/zero --rail 60E1 -o c.csv"}) {
    const auto result =
        run_shell("cd " + quoted(folder.path()) + " && timeout 20 " LIGHTSTRIPE_COMMAND " " + command);
    EXPECT_EQ(result.exit_code, 1) << command;
    EXPECT_THAT(result.err, HasSubstr("error: /dev/zero: ")) << command;
  }
}

/// A simulated session with its results, and each command that writes something over it.
class SignalledCommands : public ::testing::Test {
 protected:
  static CommandResult in(const fs::path& folder, const std::string& line) {
    return run_shell("cd " + quoted(folder) + "; " + kProgramOnPath + line);
  }
};

TEST_F(SignalledCommands, LeaveNothingTemporaryBehind) {
  const TemporaryFolder folder;
  ASSERT_EQ(
      run_lightstripe("simulate testdata/one_sensor.yaml --quiet -o " + quoted(folder.path())).exit_code, 0);
  ASSERT_EQ(in(folder.path(),
               "cp truth/rig.yaml . && lightstripe reconstruct scan.yaml -o c.ply --profiles p.csv --quiet")
                .exit_code,
            0);
  int ended_by_signal = 0;
  for (const std::string command :
       {"extract scan/solo/*.png --overlay o/v -o o/s.csv",
        "calibrate calibration.yaml -o o/r.yaml --report o/r.html",
        "verify calibration.yaml --rig rig.yaml -o o/v.csv",
        "reconstruct scan.yaml -o o/c.ply --profiles o/p.csv --view o/c.html --preview o/c.png",
        "measure p.csv --kind rail -o o/m.xlsx --report o/m.html", "merge c.ply -o o/c.ply",
        "view c.ply -o o/c.html", "conicity --wheel S1002 --rail 60E1 -o o/k.csv",
        "bench scan/solo/0001.png --repeat 200 -o o/b.csv", "simulate testdata_scene.yaml -o o/sim",
        "record 'scan/solo/*.png' -o o/rec", "generate board -o o/b.svg"}) {
    write_text(folder / "testdata_scene.yaml", text_of(LIGHTSTRIPE_SOURCE_DIR "/testdata/one_sensor.yaml"));
    for (const double after : {0.12, 0.3}) {
      fs::create_directories(folder / "o");
      const auto result = in(folder.path(), "timeout -s TERM " + std::to_string(after) + " lightstripe " +
                                                command + " >/dev/null 2>&1; echo $?");
      EXPECT_THAT(result.out, Not(HasSubstr("134"))) << command;
      ended_by_signal += result.out == "124\n" ? 1 : 0;
      for (const auto& left : fs::recursive_directory_iterator(folder / "o"))
        EXPECT_THAT(left.path().filename().string(), Not(HasSubstr(".tmp-")))
            << command << " after " << after;
      fs::remove_all(folder / "o");
    }
  }
  EXPECT_GT(ended_by_signal, 3) << "the signals came too late to say anything";
}

// 30 columns: a status line that wraps would not be drawn over.
TEST_F(SignalledCommands, StatusLinesAreAsNarrowAsTheTerminal) {
  if (run_shell("script --version").exit_code != 0) GTEST_SKIP() << "no script(1) here";
  const TemporaryFolder folder;
  ASSERT_EQ(
      run_lightstripe("simulate testdata/one_sensor.yaml --quiet -o " + quoted(folder.path())).exit_code, 0);
  write_text(folder / "run.sh",
             "stty cols 30\n" LIGHTSTRIPE_COMMAND " record 'scan/solo/*.png?frame_rate=5' -o rec\n");
  const auto shown = in(folder.path(), "script -qec 'sh run.sh' /dev/null < /dev/null");
  std::stringstream text(shown.out);
  int lines = 0;
  for (std::string line; std::getline(text, line, '\r');) {
    if (line.find("\x1b[K") == std::string::npos) continue;
    ++lines;
    EXPECT_LT(line.find("\x1b[K"), 30U) << line;
  }
  EXPECT_GT(lines, 1) << shown.out;
}

}  // namespace
}  // namespace lightstripe
