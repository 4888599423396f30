// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What belongs to the user stays as it is: no output over an input, no file of somebody else replaced, no
// result lost to a closed pipe or a full log, the same bits in every run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <chrono>
#include <map>
#include <set>
#include <thread>

#include "command_line.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// Path and bytes of every file.
std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> out;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) out[entry.path().string()] = text_of(entry.path());
  return out;
}

class NothingLost : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    ASSERT_EQ(
        run_lightstripe("simulate testdata/one_sensor.yaml --quiet -o " + quoted(*folder_ / "d")).exit_code,
        0);
    fs::copy_file(*folder_ / "d/truth/rig.yaml", *folder_ / "d/rig.yaml");
    ASSERT_EQ(in("reconstruct scan.yaml -o c.ply --profiles p.csv --quiet").exit_code, 0);
    fs::create_directories(at("overlay"));
    fs::create_directory_symlink(at("calib/solo/board"), at("overlay/solo"));
    fs::create_symlink(at("scan/solo/0001.png"), at("link.png"));
    write_text(at("features.yaml"), "features: []\nmeasurements: []\n");
  }
  static void TearDownTestSuite() { delete folder_; }

  static fs::path at(const std::string& name) { return *folder_ / "d" / name; }
  /// In the folder of the simulated session.
  static CommandResult in(const std::string& arguments) {
    return run_shell("cd " + quoted(*folder_ / "d") + " && " + LIGHTSTRIPE_COMMAND + " " + arguments);
  }
  /// A line of the shell there, in which `lightstripe` is the program.
  static CommandResult shell(const std::string& line) {
    return run_shell("cd " + quoted(*folder_ / "d") + "; " + kProgramOnPath + line);
  }

 private:
  static TemporaryFolder* folder_;
};
TemporaryFolder* NothingLost::folder_ = nullptr;

TEST_F(NothingLost, NoOutputIsAnInputOrAnotherOutput) {
  const auto before = contents(at(""));
  const std::string frame = "scan/solo/0001.png";
  for (const std::string& command : std::vector<std::string>{
           "extract " + frame + " -o " + frame,
           "extract " + frame + " -o link.png",
           "extract " + frame + " --overlay scan/solo -o s.csv",
           std::string("calibrate calibration.yaml -o calibration.yaml"),
           std::string("calibrate calibration.yaml -o r.yaml --report calib/travel.csv"),
           std::string("calibrate calibration.yaml -o r.yaml --overlay overlay"),
           std::string("calibrate calibration.yaml -o r.yaml --report ./r.yaml"),
           std::string("verify calibration.yaml --rig rig.yaml -o rig.yaml"),
           std::string("reconstruct scan.yaml -o n.ply --profiles scan/travel.csv"),
           std::string("reconstruct scan.yaml -o n.ply --profiles ./n.ply"),
           "reconstruct scan.yaml -o n.ply --preview " + frame,
           std::string("reconstruct scan.yaml -o n.ply --view rig.yaml"),
           std::string("reconstruct scan.yaml -o n.ply --mesh n.ply"),
           "reconstruct scan.yaml -o n.ply --height-map scan/solo/0001.tif",
           std::string("measure p.csv --kind rail -o p.csv"),
           std::string("measure p.csv --kind rail -o m.csv --report p.csv"),
           std::string("measure p.csv --kind rail -o m.csv --view m.csv"),
           "measure p.csv --kind rail -o m.csv --scan scan.yaml --report " + frame,
           std::string("measure p.csv --kind features --features features.yaml -o features.yaml"),
           std::string("conicity --wheel S1002 --rail p.csv -o p.csv"),
           std::string("view c.ply -o c.ply"),
           std::string("merge c.ply -o c.ply"),
           "bench " + frame + " -o " + frame,
           std::string("simulate truth/scene.yaml -o ."),
           std::string("demo truth/scene.yaml -o .")}) {
    const auto result = in(command);
    EXPECT_EQ(result.exit_code, 1) << command << "\n" << result.err;
    EXPECT_THAT(result.err, StartsWith("error: ")) << command;
    EXPECT_THAT(result.err,
                ::testing::AnyOf(HasSubstr("is one of the inputs"), HasSubstr("is another output"),
                                 HasSubstr("lightstripe has not written it")))
        << command;
  }
  EXPECT_TRUE(contents(at("")) == before);
}

TEST_F(NothingLost, MergeDoesNotCutItsOwnInput) {
  fs::create_directories(at("parts"));
  fs::copy_file(at("c.ply"), at("parts/cloud.partial.ply"));
  const auto before = contents(at("parts"));
  const auto result = in("merge parts/cloud.partial.ply -o parts/cloud.ply");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("is one of the inputs"));
  EXPECT_TRUE(contents(at("parts")) == before);
}

TEST_F(NothingLost, SimulateAndDemoReplaceOnlyWhatTheyHaveWritten) {
  const TemporaryFolder own;
  const std::string simulate = "simulate testdata/one_sensor.yaml --quiet -o " + quoted(own.path());
  write_text(own / "scan/solo/0099.png", "his picture");
  const auto refused = run_lightstripe(simulate);
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err, HasSubstr("0099.png: is there already"));
  EXPECT_EQ(contents(own.path()).size(), 1U);
  fs::remove(own / "scan/solo/0099.png");
  write_text(own / "rig.yaml", "his rig");
  write_text(own / "calib/solo/notes.txt", "his notes");
  ASSERT_EQ(run_lightstripe(simulate).exit_code, 0);
  ASSERT_EQ(run_lightstripe(simulate).exit_code, 0) << "again over its own files";
  EXPECT_EQ(text_of(own / "rig.yaml"), "his rig");
  EXPECT_EQ(text_of(own / "calib/solo/notes.txt"), "his notes");
  const auto demo = run_lightstripe("demo testdata/one_sensor.yaml -o " + quoted(own.path()));
  EXPECT_EQ(demo.exit_code, 1);
  EXPECT_THAT(demo.err, HasSubstr("rig.yaml: is there already"));
  EXPECT_EQ(text_of(own / "rig.yaml"), "his rig");
}

TEST_F(NothingLost, AShorterSimulationDeletesItsOwnPicturesOnly) {
  const TemporaryFolder own;
  ASSERT_EQ(run_lightstripe("simulate testdata/one_sensor.yaml --quiet -o " + quoted(own / "d")).exit_code,
            0);
  ASSERT_TRUE(fs::exists(own / "d/scan/solo/0005.png"));
  std::string scene = text_of("testdata/one_sensor.yaml");
  scene.replace(scene.find("frames: 6"), 9, "frames: 3");
  write_text(own / "short.yaml", scene);
  ASSERT_EQ(run_lightstripe("simulate " + quoted(own / "short.yaml") + " --quiet -o " + quoted(own / "d"))
                .exit_code,
            0);
  EXPECT_TRUE(fs::exists(own / "d/scan/solo/0002.png"));
  EXPECT_FALSE(fs::exists(own / "d/scan/solo/0005.png"));
}

TEST_F(NothingLost, TwoRunsWithOneTableDoNotMixIt) {
  const auto result = shell(
      "rm -f t1.* t2.*; lightstripe reconstruct scan.yaml -o t1.ply --profiles t.csv --quiet --threads 1 & "
      "first=$!; "
      "while [ ! -e t.partial.csv ] && kill -0 $first 2>/dev/null; do :; done; kill -STOP $first "
      "2>/dev/null; "
      "lightstripe reconstruct scan.yaml -o t2.ply --profiles t.csv --quiet; second=$?; "
      "kill -CONT $first 2>/dev/null; wait $first; echo $? $second; cmp t.csv p.csv");
  // The first may be over before it is stopped: then both are done one after the other.
  EXPECT_THAT(result.out, ::testing::AnyOf(StartsWith("0 1\n"), StartsWith("0 0\n"))) << result.err;
  if (result.out.substr(0, 3) == "0 1") {
    EXPECT_THAT(result.err, HasSubstr("is being written by another run"));
  }
  EXPECT_EQ(result.exit_code, 0) << "the table is another";
}

TEST_F(NothingLost, ALockedPartialFileIsSeen) {
  const auto result = shell(
      "rm -f l.*; (flock 9; lightstripe reconstruct scan.yaml -o l.ply --profiles l.csv) 9>l.partial.csv");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("l.csv: is being written by another run"));
  EXPECT_FALSE(fs::exists(at("l.ply")));
  EXPECT_FALSE(fs::exists(at("l.partial.journal"))) << "nothing is left of a run that could not begin";
}

TEST_F(NothingLost, PicturesThatWereRecordedAnewEndAResume) {
  fs::copy(at(""), at("../anew"), fs::copy_options::recursive);
  // A journal of the old pictures, made by killing a run at its first entry.
  const auto killed = run_shell(
      "cd " + quoted(at("../anew")) + "; " + kProgramOnPath +
      "for try in 1 2 3 4 5 6 7 8; do rm -f k.*; lightstripe reconstruct scan.yaml -o k.ply "
      "--checkpoint 0 --threads 1 --quiet & "
      "while [ ! -s k.partial.journal ] && kill -0 $! 2>/dev/null; do :; done; kill -KILL $!; wait "
      "$! 2>/dev/null; "
      "[ -s k.partial.journal ] && break; done; [ -s k.partial.journal ] || exit 9; "
      "touch -d '2001-01-01' scan/solo/0002.png; lightstripe reconstruct scan.yaml -o k.ply --resume");
  if (killed.exit_code == 9) GTEST_SKIP() << "the run is too quick to be killed here";
  EXPECT_EQ(killed.exit_code, 1) << killed.err;
  EXPECT_THAT(killed.err, HasSubstr("resume"));
  EXPECT_FALSE(fs::exists(at("../anew/k.ply")));
}

TEST_F(NothingLost, AClosedPipeOrAFullLogCostsNoResult) {
  ASSERT_EQ(in("calibrate calibration.yaml -o whole.yaml --quiet").exit_code, 0);
  for (const std::string line :
       {"lightstripe calibrate calibration.yaml -o x.yaml | true; exit ${PIPESTATUS[0]}",
        "lightstripe calibrate calibration.yaml -o x.yaml >/dev/full",
        "lightstripe calibrate calibration.yaml -o x.yaml >&-",
        "lightstripe calibrate calibration.yaml -o x.yaml >&- 2>&- <&-",
        "lightstripe calibrate calibration.yaml -o x.yaml 2>/dev/full"}) {
    fs::remove(at("x.yaml"));
    const auto result = shell("exec bash -c '" + line + "'");
    EXPECT_EQ(result.exit_code, 0) << line << "\n" << result.err;
    EXPECT_TRUE(text_of(at("x.yaml")) == text_of(at("whole.yaml"))) << line;
  }
}

TEST_F(NothingLost, MessagesNeverGoIntoAResult) {
  ASSERT_EQ(in("extract scan/solo/*.png -o whole.csv").exit_code, 0);
  for (const std::string closed : {">&-", "2>&-", ">&- 2>&-", "<&- >&- 2>&-"}) {
    fs::remove(at("x.csv"));
    EXPECT_EQ(shell("lightstripe extract scan/solo/*.png --explain -o x.csv " + closed).exit_code, 0)
        << closed;
    EXPECT_TRUE(text_of(at("x.csv")) == text_of(at("whole.csv"))) << closed;
  }
}

TEST_F(NothingLost, AnOverlayThatCannotBeDrawnCostsNoRig) {
  write_text(at("file"), "no folder");
  const auto result = in("calibrate calibration.yaml -o kept.yaml --overlay file/overlay");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(fs::exists(at("kept.yaml")));
}

TEST_F(NothingLost, PipesAreRefusedByNameAndNeverWaitedFor) {
  shell("mkfifo pipe.ply pipe.csv pipe.png pipe.yaml pipe.ban");
  for (const std::string command :
       {"reconstruct scan.yaml -o pipe.ply", "extract pipe.png -o x.csv", "calibrate pipe.yaml",
        "measure pipe.csv --kind rail", "measure pipe.ban --kind rail", "merge pipe.ply -o x.ply",
        "view pipe.ply -o x.html", "reconstruct scan.yaml --rig pipe.yaml -o x.ply",
        "measure /dev/zero --kind rail", "conicity --wheel S1002 --rail pipe.ban"}) {
    const auto result = shell("timeout 20 lightstripe " + command);
    EXPECT_EQ(result.exit_code, 1) << command << result.err;
    EXPECT_THAT(result.err, ::testing::AnyOf(HasSubstr("is a pipe"), HasSubstr("is a device"))) << command;
  }
}

TEST_F(NothingLost, NamesThatLeaveTheFolderAreRefused) {
  std::string rig = text_of(at("rig.yaml")), session = text_of(at("calibration.yaml"));
  for (std::string* text : {&rig, &session}) text->replace(text->find("name: solo"), 10, "name: ../x");
  write_text(at("bad_rig.yaml"), rig);
  write_text(at("bad_session.yaml"), session);
  for (const std::string command :
       {"calibrate bad_session.yaml -o x.yaml", "reconstruct scan.yaml --rig bad_rig.yaml -o x.ply"}) {
    const auto result = in(command);
    EXPECT_EQ(result.exit_code, 1) << command;
    EXPECT_THAT(result.err, HasSubstr("cannot be a sensor's name")) << command;
  }
}

TEST_F(NothingLost, PicturesNamedWithStarsQuotesAndFormulas) {
  fs::create_directories(at("odd"));
  for (const std::string name : {"a*.png", "=cmd|' C calc'!A0.png", "it's {a}, \"b\".png"})
    fs::copy_file(at("scan/solo/0001.png"), at("odd") / name, fs::copy_options::skip_existing);
  const auto result = shell(
      "cd odd; lightstripe extract 'a*.png' \"=cmd|' C calc'!A0.png\" \"it's {a}, \\\"b\\\".png\" -o "
      "../odd.csv");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string table = text_of(at("odd.csv"));
  EXPECT_THAT(table, HasSubstr("\na*.png,"));
  EXPECT_THAT(table, HasSubstr("\n'=cmd|"));
  EXPECT_THAT(table, HasSubstr("\n\"it's {a}, \"\"b\"\".png\","));
}

TEST_F(NothingLost, RunRecordsAreYamlWhateverTheNames) {
  const std::string name = "q'\"{}: #,\n\xe2\x80\xa8.csv";
  fs::copy_file(at("p.csv"), at(name), fs::copy_options::skip_existing);
  const auto result = shell("lightstripe measure " + quoted("q") + "*.csv --kind rail -o odd_m.csv");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto parsed = shell(
      "/usr/bin/python3 -c 'import yaml,sys; d=yaml.safe_load(open(\"odd_m.csv.run.yaml\")); "
      "sys.stdout.write(d[\"inputs\"][0][\"file\"])' || exit 77");
  if (parsed.exit_code == 77 && parsed.err.find("No module") != std::string::npos)
    GTEST_SKIP() << "no Python yaml";
  EXPECT_EQ(parsed.exit_code, 0) << parsed.err << text_of(at("odd_m.csv.run.yaml"));
  EXPECT_THAT(parsed.out, HasSubstr("q'\"{}: #,\n\xe2\x80\xa8.csv"));
}

TEST_F(NothingLost, ARecordingsNotesAreYamlWhateverTheSourcesName) {
  const auto result = shell(
      "rm -rf \"it's: {\" quoted; cp -r scan/solo \"it's: {\"; lightstripe record \"it's: {/*.png\" -o "
      "quoted "
      "--quiet && "
      "/usr/bin/python3 -c 'import yaml; print(yaml.safe_load(open(\"quoted/record.yaml\"))[\"source\"])'");
  if (result.err.find("No module") != std::string::npos) GTEST_SKIP() << "no Python yaml";
  EXPECT_EQ(result.out, "it's: {/*.png\n") << result.err;
}

TEST_F(NothingLost, ASignalLeavesNoTemporaryFile) {
  fs::create_directories(at("signals"));
  for (const std::string command :
       {"bench scan/solo/0001.png --repeat 100000 -o signals/b.csv",
        "extract $(for i in $(seq 300); do echo scan/solo/0001.png; done) -o signals/s.csv --threads 1"}) {
    for (const std::string signal : {"TERM", "INT", "HUP"}) {
      const auto result =
          shell("timeout -s " + signal + " 0.3 lightstripe " + command + " >/dev/null 2>&1; echo $?");
      EXPECT_THAT(result.out, Not(HasSubstr("134"))) << command;
      for (const auto& left : fs::directory_iterator(at("signals")))
        EXPECT_THAT(left.path().filename().string(), Not(HasSubstr(".tmp-"))) << command << " " << signal;
      fs::remove_all(at("signals"));
      fs::create_directories(at("signals"));
    }
  }
}

TEST_F(NothingLost, AFullDiskAtTheVeryStartLeavesNothing) {
  for (const std::string command :
       {"simulate truth/scene.yaml -o full/sim", "reconstruct scan.yaml -o full/c.ply --profiles full/p.csv",
        "extract scan/solo/*.png -o full/s.csv", "measure p.csv --kind rail -o full/m.csv",
        "record 'scan/solo/*.png' -o full/rec", "view c.ply -o full/v.html",
        "generate board -o full/b.svg"}) {
    fs::remove_all(at("full"));
    fs::create_directories(at("full"));
    EXPECT_EQ(shell("ulimit -f 0; exec lightstripe " + command + " >&- 2>&-").exit_code, 1) << command;
    EXPECT_TRUE(fs::is_empty(at("full"))) << command;
  }
}

TEST_F(NothingLost, AFileOrLinkInAFoldersPlaceStays) {
  write_text(at("a_file"), "his");
  fs::create_symlink("a_file", at("a_link"));
  fs::create_directories(at("empty"));
  for (const std::string place : {"a_file", "a_link"})
    for (const std::string command : {"simulate truth/scene.yaml -o ", "record 'scan/solo/*.png' -o "}) {
      EXPECT_EQ(in(command + place).exit_code, 1) << command << place;
      EXPECT_EQ(text_of(at(place)), "his") << command << place;
      EXPECT_TRUE(fs::is_symlink(at("a_link"))) << command << place;
    }
  EXPECT_EQ(shell("ulimit -f 0; exec lightstripe simulate truth/scene.yaml -o empty >&- 2>&-").exit_code, 1);
  EXPECT_TRUE(fs::exists(at("empty"))) << "his own folder";
}

TEST_F(NothingLost, MistypedCommandsAndValuesGetOurWords) {
  const std::map<std::string, std::string> sentences{
      {"calibarte x.yaml", "calibarte: is no command, did you mean calibrate?"},
      {"measure p.csv --kind raill", "--kind: 'raill' is none of rail, wheel, features"},
      {"measure p.csv --kind rail --csv-style exel", "--csv-style: 'exel' is none of plain, excel"},
      {"measure p.csv --kind rail --reprot x", "did you mean --report?"},
      {"measure p.csv --knid rail", "--knid: is no option here, did you mean --kind?"},
      {"measure p.csv --kind rail --plot abc", "--plot: 'abc' is no number"}};
  for (const auto& [command, sentence] : sentences) {
    const auto result = in(command);
    EXPECT_EQ(result.exit_code, 2) << command;
    EXPECT_THAT(result.err, HasSubstr(sentence)) << command;
    EXPECT_THAT(result.err, Not(HasSubstr("->"))) << command;
  }
  const std::string help = in("measure --help").out;
  EXPECT_THAT(help, HasSubstr("--kind rail|wheel|features"));
  EXPECT_THAT(help, HasSubstr("--gauge-side left|right"));
  EXPECT_THAT(help, HasSubstr("--lip-mm NUMBER"));
  EXPECT_THAT(help, Not(HasSubstr("->")));
}

TEST_F(NothingLost, TheSameSessionGivesTheSameRigInThirtyEnvironments) {
  const auto result = shell(
      "for i in $(seq 30); do env -i PATH=\"$PATH\" PAD=$(head -c $((i * 7)) /dev/zero | tr '\\0' x) "
      "MALLOC_ARENA_MAX=$((i % 3 + 1)) lightstripe calibrate calibration.yaml -o e.yaml --quiet --threads "
      "$((i % 3 + "
      "1)) || exit 5; "
      "cksum < e.yaml; done | sort -u | wc -l");
  EXPECT_EQ(result.out, "1\n") << result.err;
}

}  // namespace
}  // namespace lightstripe
