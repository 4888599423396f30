// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/background_pictures.h"

#include <gmock/gmock.h>

#include <cmath>

#include "io/tables.h"
#include "pipeline/extract_job.h"
#include "pipeline/recording.h"
#include "tests/io/temp_folder.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// Bars of a print along a line of light at x = 60; `gain` of the exposure, bars moved by `shift` px.
Image8 picture(double laser, double gain = 1, int shift = 0) {
  Image8 out(120, 90);
  for (int y = 0; y < 90; ++y)
    for (int x = 0; x < 120; ++x) {
      const double print = 20 + 70 * (((x + shift) / 11 + y / 30) % 2), d = x - 60;
      out(x, y) = static_cast<std::uint8_t>(std::min(255.0, gain * print + laser * std::exp(-0.125 * d * d)));
    }
  return out;
}

std::string complaint(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

struct BackgroundFiles : testing::Test {
  BackgroundFiles() {
    fs::create_directories(folder_ / "off");
    fs::create_directories(folder_ / "on");
    for (const int k : {1, 2, 3}) {
      write_image(folder_ / ("on/frame_0" + std::to_string(k) + ".png"), picture(50).view());
      write_image(folder_ / ("off/dark_" + std::to_string(k) + ".png"), picture(0).view());
    }
  }
  std::string on(int k) const { return (folder_ / ("on/frame_0" + std::to_string(k) + ".png")).string(); }
  TempFolder folder_;
};

TEST_F(BackgroundFiles, OneForAllOrOneEachByNameOrNumber) {
  const BackgroundPictures one(folder_.path(), "off/dark_1.png", "key"),
      each(folder_.path(), "off/*.png", "key");
  EXPECT_EQ(one.file_for(on(3)).filename(), "dark_1.png");
  EXPECT_EQ(each.file_for(on(3)).filename(), "dark_3.png");
  EXPECT_EQ(each.file_for("elsewhere/dark_2.jpg").filename(), "dark_2.png");
  EXPECT_THAT(complaint([&] { each.file_for("on/frame_07.png"); }),
              HasSubstr("key: has no picture for on/frame_07.png"));
}

TEST_F(BackgroundFiles, ExtractFindsTheLineOnly) {
  ExtractJob job;
  job.images = {on(1), on(2)};
  job.background = (folder_ / "off/*.png").string();
  job.table = folder_ / "stripes.csv";
  const ExtractResult with = extract(job);
  EXPECT_EQ(with.lines, 2U);
  EXPECT_GT(with.points, 170U);
  EXPECT_TRUE(with.warnings.empty());
  job.background.clear();
  EXPECT_LT(extract(job).points, 120U) << "the print hides most of the line";
}

TEST_F(BackgroundFiles, AChangedExposureIsToldAndAnotherSceneRefused) {
  write_image(folder_ / "brighter.png", picture(50, 1.3).view());
  write_image(folder_ / "moved.png", picture(50, 1, 5).view());
  write_image(folder_ / "small.png", Image8(50, 40).view());
  ExtractJob job;
  job.background = (folder_ / "off/dark_1.png").string();
  job.table = folder_ / "stripes.csv";
  const auto run = [&](const std::string& file) {
    job.images = {(folder_ / file).string()};
    return extract(job);
  };
  const ExtractResult brighter = run("brighter.png");
  EXPECT_EQ(brighter.lines, 1U);
  ASSERT_EQ(brighter.warnings.size(), 1U);
  EXPECT_THAT(brighter.warnings[0], HasSubstr("% brighter than its background"));
  EXPECT_THAT(complaint([&] { run("moved.png"); }),
              HasSubstr("and a laser only adds light; take the background"));
  EXPECT_THAT(complaint([&] { run("small.png"); }), HasSubstr("has 120 x 90 px"));
}

TEST_F(BackgroundFiles, AScanReadsItsFramesWithoutTheBackground) {
  Rig rig;
  rig.sensors.resize(1);
  rig.sensors[0].name = "one";
  rig.sensors[0].camera.width = 120;
  rig.sensors[0].camera.height = 90;
  Scan scan;
  scan.folder = folder_.path();
  scan.frames = {{"one", "on/*.png"}};
  scan.background.of_sensor = {{"", "off/*.png"}};
  const Recording recording(scan, "scan.yaml", rig);
  EXPECT_TRUE(recording.warnings().empty());
  const auto frame = recording.read(recording.first_frame(), 0);
  ASSERT_TRUE(frame);
  const Image8& light = std::get<Image8>(*frame);
  EXPECT_NEAR(light(60, 40), 12 + 50, 1);
  EXPECT_NEAR(light(20, 40), 12, 1);
}

}  // namespace
}  // namespace lightstripe
