// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Every kind of bad input of bad_input.txt gets exactly the exit code and the words that stand there.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "command_line.h"
#include "markdown.h"
#include "test_paths.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

struct Case {
  std::string name, user, arguments;
  std::vector<std::string> preparation;
  int exit_code = -1;
  std::string err;
};

std::vector<Case> read_cases(const std::string& list) {
  std::vector<Case> cases;
  for (const auto& line : lines_of(text_of(std::string(LIGHTSTRIPE_SOURCE_DIR "/tests/apps/") + list))) {
    if (line.starts_with("## ")) {
      cases.push_back({line.substr(3), "", "", {}, -1, ""});
    } else if (cases.empty() || line.empty()) {
      continue;
    } else if (Case& last = cases.back(); line.starts_with("$ ")) {
      last.preparation.push_back(line.substr(2));
    } else if (!line.starts_with("= ")) {
      last.user = line.substr(0, line.find('>'));
      last.arguments = line.substr(line.find('>') + 2);
    } else if (last.exit_code < 0) {
      last.exit_code = std::stoi(line.substr(2));
      if (line.size() > 4) last.err = line.substr(4) + "\n";
    } else {
      last.err += line.substr(2) + "\n";
    }
  }
  return cases;
}

class BadInput : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    setenv("GCOV_ERROR_FILE", "/dev/null",
           1);  // of a coverage build, which cannot write its counts as nobody
    folder_ = new TemporaryFolder;
    const std::string scan =
        "reconstruct " + quoted(good() / "scan.yaml") + " --rig " + quoted(good() / "truth/rig.yaml");
    ASSERT_EQ(run_lightstripe("simulate testdata/one_sensor.yaml -o " + quoted(good())).exit_code, 0);
    ASSERT_EQ(run_lightstripe(scan + " -o " + quoted(good() / "cloud.ply") + " --profiles " +
                              quoted(good() / "profiles.csv"))
                  .exit_code,
              0);
    ASSERT_EQ(run_lightstripe(scan + " -o " + quoted(good() / "cloud.pcd")).exit_code, 0);
    fs::permissions(folder_->path(), fs::perms(0755));
  }
  static void TearDownTestSuite() { delete folder_; }
  static fs::path good() { return *folder_ / "good"; }

  /// What stands before the program's name; nothing where this user cannot be had here.
  static std::optional<std::string> prefix(const std::string& user) {
    if (user.starts_with("limited")) return "ulimit -f 16; ";
    if (!user.starts_with("as nobody") || geteuid() != 0) return "";
    if (std::system("setpriv --reuid=65534 --regid=65534 --clear-groups test -x " LIGHTSTRIPE_COMMAND) != 0)
      return std::nullopt;
    return "setpriv --reuid=65534 --regid=65534 --clear-groups ";
  }

  static std::vector<std::string> left_behind(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().filename().string().starts_with("out") && !entry.is_symlink())
        names.push_back(entry.path().filename().string());
    return names;
  }

  static void check(const Case& test) {
    const auto before = prefix(test.user);
    if (!before) {
      std::cout << "left out, no other user can be had: " << test.name << "\n";
      return;
    }
    const TemporaryFolder work;
    fs::permissions(work.path(), fs::perms(0777));
    fs::create_directory_symlink(good(), work / "good");
    const std::string in_folder = "cd " + quoted(work.path()) + " && ";
    for (const auto& line : test.preparation)
      ASSERT_EQ(std::system((in_folder + line).c_str()), 0) << test.name << ": " << line;
    const auto result = run_shell(in_folder + *before + LIGHTSTRIPE_COMMAND + " " + test.arguments);
    EXPECT_EQ(result.exit_code, test.exit_code) << test.name;
    EXPECT_EQ(result.err, test.err) << test.name;
    if (test.exit_code != 1) return;
    EXPECT_THAT(left_behind(work.path()), ::testing::IsEmpty()) << test.name;
  }

 private:
  static TemporaryFolder* folder_;
};
TemporaryFolder* BadInput::folder_ = nullptr;

TEST_F(BadInput, GetsItsExitCodeAndItsSentence) {
  const auto cases = read_cases("bad_input.txt");
  EXPECT_GE(cases.size(), 118U);
  for (const Case& test : cases) check(test);
}

TEST_F(BadInput, OfFurtherKindsGetsItsExitCodeAndItsSentence) {
  const auto cases = read_cases("bad_input_further.txt");
  EXPECT_GE(cases.size(), 60U);
  for (const Case& test : cases) check(test);
}

}  // namespace
}  // namespace lightstripe
