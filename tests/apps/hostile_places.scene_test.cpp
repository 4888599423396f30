// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Paths and disks as they are in the field: blanks and umlauts in names, links, full disks, files that are
// gone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mount.h>

#include <algorithm>

#include "command_line.h"
#include "io/rig_file.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class HostilePlaces : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    ASSERT_EQ(run_lightstripe("simulate testdata/one_sensor.yaml -o " + quoted(data())).exit_code, 0);
  }
  static void TearDownTestSuite() { delete folder_; }
  /// Blanks, an umlaut, a Chinese character and a quote's cousin in every path of these tests.
  static fs::path data() { return *folder_ / "Gleis 3, Übergabe 轨 (v2)"; }
  static fs::path scan() { return data() / "scan.yaml"; }
  static fs::path rig() { return data() / "truth/rig.yaml"; }

  static void expect_one_error(const CommandResult& result, const std::string& part) {
    EXPECT_EQ(result.exit_code, 1) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_THAT(result.err, StartsWith("error: "));
    EXPECT_THAT(result.err, HasSubstr(part));
  }

  static std::size_t files_in(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
  }

  TemporaryFolder out_;

 private:
  static TemporaryFolder* folder_;
};
TemporaryFolder* HostilePlaces::folder_ = nullptr;

TEST_F(HostilePlaces, BlanksAndLettersOfAnyLanguageInPathsAreJustLetters) {
  const auto calibrated = run_lightstripe("calibrate " + quoted(data() / "calibration.yaml") + " -o " +
                                          quoted(out_ / "Gerät 1.yaml"));
  EXPECT_EQ(calibrated.exit_code, 0) << calibrated.err;
  const auto result =
      run_lightstripe("reconstruct " + quoted(scan()) + " --rig " + quoted(out_ / "Gerät 1.yaml") + " -o " +
                      quoted(out_ / "Wolke 点云.ply"));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_GT(fs::file_size(out_ / "Wolke 点云.ply"), 1000U);
}

TEST_F(HostilePlaces, LinksToFilesAndFoldersAreFollowed) {
  fs::create_directory_symlink(data(), out_ / "link");
  const auto result = run_lightstripe("reconstruct " + quoted(out_ / "link/scan.yaml") + " --rig " +
                                      quoted(rig()) + " -o " + quoted(out_ / "cloud.ply"));
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(HostilePlaces, AFullDiskIsAnErrorThatNamesTheFile) {
  const auto frame = quoted(data() / "scan/solo/0002.png");
  expect_one_error(run_lightstripe("extract " + frame + " -o /dev/full"), "/dev/full");
  expect_one_error(
      run_lightstripe("calibrate --quiet " + quoted(data() / "calibration.yaml") + " -o /dev/full"),
      "/dev/full");
  fs::create_symlink("/dev/full", out_ / "cloud.ply");
  expect_one_error(run_lightstripe("reconstruct " + quoted(scan()) + " --rig " + quoted(rig()) + " -o " +
                                   quoted(out_ / "cloud.ply")),
                   "/dev/full");
}

/// A disk of 40 kB, where this user may mount one.
class SmallDisk {
 public:
  explicit SmallDisk(fs::path folder) : folder_(std::move(folder)) {
    fs::create_directories(folder_);
    mounted_ = mount("tmpfs", folder_.c_str(), "tmpfs", 0, "size=40k") == 0;
  }
  ~SmallDisk() {
    if (mounted_) umount(folder_.c_str());
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  bool mounted() const { return mounted_; }
  fs::path operator/(const std::string& name) const { return folder_ / name; }
  /// Files under a final name; a slow run may leave partial ones, to be gone on from when there is room.
  int final_files() const {
    int count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder_))
      count += int(entry.is_regular_file() &&
                   entry.path().filename().string().find(".partial.") == std::string::npos);
    return count;
  }
  void clear() {
    for (const auto& entry : fs::directory_iterator(folder_)) fs::remove_all(entry.path());
  }

 private:
  fs::path folder_;
  bool mounted_ = false;
};

TEST_F(HostilePlaces, ADiskThatFillsUpLeavesNoHalfFile) {
  SmallDisk disk(out_ / "disk");
  if (!disk.mounted()) GTEST_SKIP() << "this user may not mount a tmpfs";
  const std::string scanned = "reconstruct --quiet " + quoted(scan()) + " --rig " + quoted(rig()) + " -o ";
  for (const std::string& command :
       {scanned + quoted(disk / "c.ply") + " --profiles " + quoted(disk / "p.csv"),
        "extract --quiet " + quoted(data() / "scan/solo/0001.png") + " --overlay " +
            quoted(disk / "overlay") + " -o " + quoted(out_ / "s.csv"),
        "calibrate --quiet " + quoted(data() / "calibration.yaml") + " --report " + quoted(disk / "r.html") +
            " -o " + quoted(disk / "rig.yaml"),
        "simulate --quiet testdata/one_sensor.yaml -o " + quoted(disk / "simulated")}) {
    expect_one_error(run_lightstripe(command), "(No space left on device); free some space");
    // calibrate writes the rig and its record before the report: they are whole, and a report that does not
    // fit on the disk must not cost the rig.
    const bool keeps_rig = command.starts_with("calibrate");
    EXPECT_EQ(disk.final_files(), keeps_rig ? 2 : 0) << command;
    if (keeps_rig) {
      EXPECT_EQ(read_rig(disk / "rig.yaml").sensors.size(), 1U);
    }
    disk.clear();
  }
}

TEST_F(HostilePlaces, AFolderThatCannotBeWrittenIsAnError) {
  // /proc takes no files, not even root's.
  expect_one_error(
      run_lightstripe("extract " + quoted(data() / "scan/solo/0002.png") + " -o /proc/stripes.csv"),
      "/proc/stripes.csv");
}

TEST_F(HostilePlaces, AFrameThatHasVanishedIsNamed) {
  // A link to nowhere is listed like a picture, and gone when it is opened.
  fs::copy(data() / "scan", out_ / "scan", fs::copy_options::recursive);
  fs::remove(out_ / "scan/solo/0003.png");
  fs::create_symlink("nowhere.png", out_ / "scan/solo/0003.png");
  write_text(out_ / "scan.yaml",
             "rig: '" + rig().string() + "'\nframes: {solo: scan/solo/*.png}\ntravel: {step: 2}\n");
  const std::string command =
      "reconstruct " + quoted(out_ / "scan.yaml") + " -o " + quoted(out_ / "cloud.ply");
  expect_one_error(run_lightstripe(command + " --strict"), "0003.png");
  EXPECT_FALSE(fs::exists(out_ / "cloud.ply"));
  const auto tolerant = run_lightstripe(command);
  EXPECT_EQ(tolerant.exit_code, 0);
  EXPECT_THAT(tolerant.err, HasSubstr("0003.png"));
}

TEST_F(HostilePlaces, AFolderInPlaceOfAFileIsNamed) {
  expect_one_error(
      run_lightstripe("extract " + quoted(data() / "scan/solo") + " -o " + quoted(out_ / "s.csv")), "solo");
  expect_one_error(run_lightstripe("reconstruct " + quoted(data()) + " -o " + quoted(out_ / "cloud.ply")),
                   "Gleis 3");
  EXPECT_EQ(files_in(out_.path()), 0U);
}

}  // namespace
}  // namespace lightstripe
