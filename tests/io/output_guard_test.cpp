// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/output_guard.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "io/sensor_name.h"
#include "temp_folder.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

std::string complaint(const std::vector<fs::path>& inputs, const std::vector<fs::path>& outputs) {
  try {
    guard_outputs(inputs, outputs);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(OutputGuard, AnInputIsFoundUnderAnyName) {
  const TempFolder folder;
  const fs::path input = folder.write("a/in.csv", "x");
  fs::create_symlink(input, folder / "soft.csv");
  fs::create_hard_link(input, folder / "hard.csv");
  fs::create_directory_symlink(folder / "a", folder / "b");
  for (const fs::path& name : {input, folder / "a/./in.csv", folder / "a/../a/in.csv", folder / "soft.csv",
                               folder / "hard.csv", folder / "b/in.csv"})
    EXPECT_THAT(complaint({input}, {name}), HasSubstr("is one of the inputs")) << name;
  EXPECT_EQ(complaint({input}, {folder / "a/out.csv"}), "");
}

TEST(OutputGuard, TwoOutputsOfOneNameAreRefusedBeforeTheyExist) {
  const TempFolder folder;
  fs::create_directories(folder / "a");
  fs::create_directory_symlink(folder / "a", folder / "b");
  EXPECT_THAT(complaint({}, {folder / "x.ply", folder / "./x.ply"}), HasSubstr("another output"));
  EXPECT_THAT(complaint({}, {folder / "a/x.ply", folder / "b/x.ply"}), HasSubstr("another output"));
  EXPECT_EQ(complaint({}, {folder / "x.ply", folder / "x.csv", "", ""}), "");
}

TEST(OutputGuard, AnInputThatIsNotThereYetIsFoundByItsName) {
  const TempFolder folder;
  fs::create_directories(folder / "a");
  fs::create_directory_symlink(folder / "a", folder / "b");
  EXPECT_THAT(complaint({folder / "a/out.csv"}, {folder / "b/out.csv"}), HasSubstr("is one of the inputs"));
}

TEST(OutputGuard, DevicesMayBeNamedTwice) {
  EXPECT_EQ(complaint({"/dev/null"}, {"/dev/null", "/dev/null"}), "");
}

TEST(OutputGuard, SensorNamesStayInTheirFolder) {
  for (const std::string name : {"../x", "/x", "a/b", "..", ".", "", "a\\b", ".hidden", "a\nb"})
    EXPECT_THROW(check_sensor_name(name, "name"), Error) << name;
  for (const std::string name : {"gauge", "a, b", "it's", "Kamera 1 \"links\"", "轨", "a..b"})
    EXPECT_NO_THROW(check_sensor_name(name, "name")) << name;
}

}  // namespace
}  // namespace lightstripe
