// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Long recordings by the command line: parts and their merging, gaps, killing, interrupting and resuming.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <thread>

#include "command_line.h"
#include "core/random.h"
#include "reconstruct/cloud.h"
#include "test_paths.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

/// A recording of 240 frames: links to four of a small simulated one.
class Recordings : public ::testing::Test {
 protected:
  static constexpr int kFrames = 240;

  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    const auto result = run_lightstripe("simulate testdata/one_sensor.yaml -o " + quoted(*folder_ / "data"));
    ASSERT_EQ(result.exit_code, 0) << result.err;
    fs::create_directories(*folder_ / "long");
    std::string travel = "frame,travel_mm\n";
    for (int i = 0; i < kFrames; ++i) {
      fs::create_symlink(picture(i % kPictures), *folder_ / "long" / (std::to_string(i) + ".png"));
      travel += std::to_string(i) + "," + std::to_string(0.5 * i) + "\n";
    }
    write_text(*folder_ / "travel.csv", travel);
    write_scan("scan.yaml", "long/*.png", "travel.csv");
    const auto begin = std::chrono::steady_clock::now();
    ASSERT_EQ(reconstruct("scan.yaml", "whole", "--threads 2").exit_code, 0);
    run_time_ = std::chrono::steady_clock::now() - begin;
  }
  static void TearDownTestSuite() { delete folder_; }

  static constexpr int kPictures = 4;
  static fs::path picture(int i) {
    return *folder_ / "data/scan/solo" / ("000" + std::to_string(i) + ".png");
  }
  static fs::path at(const std::string& name) { return *folder_ / name; }
  static void write_scan(const std::string& name, const std::string& pictures, const std::string& travel) {
    write_text(at(name), "rig: data/truth/rig.yaml\nframes: {solo: '" + pictures +
                             "'}\ntravel: {file: " + travel + "}\n");
  }
  static std::string command(const std::string& scan, const std::string& output,
                             const std::string& more = "") {
    return "reconstruct " + quoted(at(scan)) + " -o " + quoted(at(output + ".ply")) + " --profiles " +
           quoted(at(output + ".csv")) + " " + more;
  }
  static CommandResult reconstruct(const std::string& scan, const std::string& output,
                                   const std::string& more = "") {
    return run_lightstripe(command(scan, output, more));
  }
  /// Both files are those of the undisturbed run, and nothing is left beside them.
  static void expect_whole(const std::string& output) {
    EXPECT_TRUE(text_of(at(output + ".ply")) == text_of(at("whole.ply"))) << "another cloud";
    EXPECT_TRUE(text_of(at(output + ".csv")) == text_of(at("whole.csv"))) << "other sections";
    for (const std::string rest :
         {".partial.ply", ".partial.csv", ".partial.journal", ".partial.ply.run.yaml"})
      EXPECT_FALSE(fs::exists(at(output + rest))) << rest;
  }

  /// How many times to kill; scripts/kill_runs asks for 200.
  static int number_of_kills() {
    const char* text = std::getenv("LIGHTSTRIPE_KILLS");
    return text == nullptr ? 10 : std::stoi(text);
  }
  static double run_time_us() { return 1e6 * run_time_.count(); }

  /// The run as a process of its own; returns its id.
  static pid_t start(const std::string& output, const std::string& more) {
    const pid_t child = fork();
    if (child != 0) return child;
    const int null = open("/dev/null", O_WRONLY);
    dup2(null, STDOUT_FILENO);
    const int err = open(at("err").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(err, STDERR_FILENO);
    const std::string line =
        "exec " + std::string(LIGHTSTRIPE_COMMAND) + " " + command("scan.yaml", output, more);
    execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
    _exit(127);
  }

  /// Kills a run so long after its start, or as soon as the cloud has its final name; false where it was over
  /// before.
  static bool start_and_kill(const std::string& output, const std::string& more, bool while_renaming,
                             std::chrono::microseconds after) {
    const pid_t child = start(output, more);
    int status = 0;
    if (!while_renaming) std::this_thread::sleep_for(after);
    while (while_renaming && !fs::exists(at(output + ".ply"))) {
      if (waitpid(child, &status, WNOHANG) == child) return false;
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
    kill(child, SIGKILL);
    waitpid(child, &status, 0);
    return WIFSIGNALED(status);
  }

  /// Starts a run and sends it a signal, so long after it began to write; returns what waitpid says.
  static int start_and_signal(const std::string& output, const std::string& more, int signal,
                              std::chrono::microseconds after) {
    const pid_t child = start(output, more);
    const fs::path journal = at(output + ".partial.journal");
    const auto size = [&] { return fs::exists(journal) ? fs::file_size(journal) : 0; };
    const auto before = size();
    int status = 0;
    while (size() == before)
      if (std::this_thread::sleep_for(std::chrono::milliseconds(2));
          waitpid(child, &status, WNOHANG) == child)
        return status;
    std::this_thread::sleep_for(after);
    kill(child, signal);
    waitpid(child, &status, 0);
    return status;
  }

 private:
  static TemporaryFolder* folder_;
  static std::chrono::duration<double> run_time_;
};
TemporaryFolder* Recordings::folder_ = nullptr;
std::chrono::duration<double> Recordings::run_time_{};

TEST_F(Recordings, PartsMergedAreTheBytesOfOneRun) {
  std::string clouds, tables;
  for (const std::string range : {"150:151", ":150", "151:"}) {
    const std::string name = "part" + range.substr(0, range.find(':'));
    ASSERT_EQ(reconstruct("scan.yaml", name, "--frames " + range).exit_code, 0);
    clouds += " " + quoted(at(name + ".ply"));
    tables += " " + quoted(at(name + ".csv"));
  }
  ASSERT_EQ(run_lightstripe("merge" + clouds + " -o " + quoted(at("merged.ply"))).exit_code, 0);
  ASSERT_EQ(run_lightstripe("merge" + tables + " -o " + quoted(at("merged.csv"))).exit_code, 0);
  expect_whole("merged");
}

TEST_F(Recordings, PartsThatOverlapAreRefused) {
  ASSERT_EQ(reconstruct("scan.yaml", "first", "--frames 0:3").exit_code, 0);
  ASSERT_EQ(reconstruct("scan.yaml", "second", "--frames 2:5").exit_code, 0);
  for (const std::string type : {".ply", ".csv"}) {
    const auto result = run_lightstripe("merge " + quoted(at("first" + type)) + " " +
                                        quoted(at("second" + type)) + " -o " + quoted(at("overlap" + type)));
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err, HasSubstr("has frames 2 to 4, and"));
    EXPECT_FALSE(fs::exists(at("overlap" + type)));
  }
}

TEST_F(Recordings, ARangeOutsideTheRecordingIsAnError) {
  EXPECT_THAT(reconstruct("scan.yaml", "none", "--frames 240:500").err,
              HasSubstr("has frames 0 to 239 only"));
  EXPECT_THAT(reconstruct("scan.yaml", "none", "--frames 5").err, HasSubstr("is no range of frames"));
  EXPECT_THAT(reconstruct("scan.yaml", "none", "--frames 7:7").err, HasSubstr("is no range of frames"));
}

// Every run is killed at a random time (seeded), now and then while it renames its files, and of every fourth
// the resumed run as well; what is resumed to the end has to be the bytes of the undisturbed run each time.
TEST_F(Recordings, KilledAndResumedRunsEndInTheSameBytes) {
  const int wanted = number_of_kills();
  Random random(20);
  int kills = 0, with_something_done = 0, identical = 0;
  // On a busy machine many runs are killed before their first checkpoint: as many more follow as it takes.
  const auto enough = [&] { return identical >= wanted && with_something_done >= wanted / 3; };
  for (int round = 0; !enough() && round < 6 * wanted; ++round) {
    const int before = kills;
    std::string more = "--threads 2 --checkpoint 0.02";
    for (int attempt = 0; attempt < (round % 4 == 0 ? 2 : 1); ++attempt) {
      const bool while_renaming = random.uniform(0, 1) < 0.1;
      const auto after = std::chrono::microseconds(static_cast<int>(random.uniform(0, 1) * run_time_us()));
      if (!start_and_kill("killed", more, while_renaming, after)) break;
      ++kills;
      if (text_of(at("killed.partial.journal")).find("done ") != std::string::npos) ++with_something_done;
      more = "--threads 3 --checkpoint 0.02 --resume";
    }
    const auto resumed = reconstruct("scan.yaml", "killed", "--threads 3 --resume");
    ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
    expect_whole("killed");
    if (HasFailure()) FAIL() << "after kill " << kills << " in round " << round;
    if (kills > before) ++identical;
    fs::remove(at("killed.ply"));
    fs::remove(at("killed.csv"));
  }
  std::cout << kills << " kills, " << with_something_done << " of them with something to go on from; "
            << identical << " killed runs resumed, all to the bytes of the undisturbed run\n";
  EXPECT_GE(identical, wanted);
  EXPECT_GE(with_something_done, wanted / 3);
}

TEST_F(Recordings, AnInterruptedRunLabelsItsPartAndGoesOn) {
  const int status = start_and_signal("stopped", "--threads 2", SIGINT, std::chrono::milliseconds(100));
  ASSERT_TRUE(WIFEXITED(status));
  ASSERT_EQ(WEXITSTATUS(status), 3) << "the run was over before its interruption";
  EXPECT_THAT(text_of(at("err")), HasSubstr("not usable: interrupted before frame"));
  EXPECT_FALSE(fs::exists(at("stopped.ply")));
  EXPECT_GT(read_cloud(at("stopped.partial.ply")).size(), 0U);  // a whole cloud of the part
  EXPECT_THAT(text_of(at("stopped.partial.ply.run.yaml")), HasSubstr("complete: false"));
  ASSERT_EQ(reconstruct("scan.yaml", "stopped", "--resume").exit_code, 0);
  expect_whole("stopped");
}

TEST_F(Recordings, AResumeWithOtherOptionsIsRefused) {
  ASSERT_EQ(WEXITSTATUS(start_and_signal("other", "--threads 2", SIGINT, std::chrono::milliseconds(100))), 3);
  const auto result = reconstruct("scan.yaml", "other", "--resume --extraction.stripe-width 7");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("belongs to a run with other inputs or options"));
}

TEST_F(Recordings, MissingPicturesAndReadingsLeaveTheOthersWhereTheyAre) {
  fs::create_directories(at("gaps"));
  std::string travel = "frame,travel_mm\n";
  for (int i = 0; i < 40; ++i) {
    if (i != 0 && i != 17 && i != 18)
      fs::create_symlink(picture(i % kPictures), at("gaps") / (std::to_string(i) + ".png"));
    if (i != 25) travel += std::to_string(i) + "," + (i == 30 ? "" : std::to_string(0.5 * i)) + "\n";
  }
  write_text(at("gaps.csv"), travel);
  write_scan("gaps.yaml", "gaps/*.png", "gaps.csv");
  const auto result = reconstruct("gaps.yaml", "gaps-out");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("frame 17 skipped: solo, frame 17: its picture is missing"));
  EXPECT_THAT(
      result.err,
      HasSubstr(
          "2 frames have no travel of their own, it is interpolated between their neighbours': 25, 30"));
  const std::string record = text_of(at("gaps-out.ply.run.yaml"));
  EXPECT_THAT(record, HasSubstr("travel_interpolated: \"25, 30\""));
  EXPECT_THAT(record, HasSubstr("{frame: 18, sensor: solo, reason: "));
  // The rows of the frames that are there are those of the undisturbed recording, to the last digit.
  std::istringstream rows(text_of(at("gaps-out.csv"))), whole_rows(text_of(at("whole.csv")));
  std::string expected;
  for (std::string row; std::getline(whole_rows, row);) {
    const int frame = row.front() == 'f' ? 1 : std::stoi(row);
    if (frame < 40 && frame != 0 && frame != 17 && frame != 18) expected += row + "\n";
  }
  EXPECT_TRUE(rows.str() == expected);
}

TEST_F(Recordings, TwoRunsDoNotWriteTheSameFiles) {
  const pid_t child = fork();
  if (child == 0) {
    std::freopen("/dev/null", "w", stdout);
    const std::string line =
        "exec " + std::string(LIGHTSTRIPE_COMMAND) + " " + command("scan.yaml", "twice", "--threads 1");
    execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
    _exit(127);
  }
  while (!fs::exists(at("twice.partial.ply"))) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  kill(child, SIGSTOP);  // else it may be done before the second begins
  const auto second = reconstruct("scan.yaml", "twice");
  kill(child, SIGCONT);
  EXPECT_EQ(second.exit_code, 1);
  EXPECT_THAT(second.err, HasSubstr("another run writes these files"));
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 0);
  expect_whole("twice");
}

}  // namespace
}  // namespace lightstripe
