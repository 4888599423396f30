// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A step of 2 mm from its pictures: as the feature tools measure it, and in the height map. The rig is the
// true one, so that what is left is extraction, triangulation and the tools themselves.
#include <gtest/gtest.h>

#include <cmath>

#include "command_line.h"
#include "io/atomic_file.h"
#include "io/csv_reader.h"
#include "io/map_files.h"

namespace lightstripe {
namespace {

// The first sensor is the rig frame's origin: the step lies at u = -308.
constexpr const char* kScene = R"(seed: 5
boards: {count: 0}
motion: {positions: 0}
scan: {frames: 8, step_mm: 2}
rail: {profile: none}
steps:
  - {base: [0, 0, -80], heights_mm: [10, 12], run_mm: 40, length_mm: 400}
)";
constexpr const char* kFeatures = R"(features:
  - {name: low, type: line, u: [-344, -312]}
  - {name: high, type: line, u: [-304, -272]}
measurements:
  - {name: step, type: step_height, of: [low, high]}
along:
  - {name: high_flat, type: flatness, of: [high]}
)";

class Steps : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    write_text(*folder_ / "scene.yaml", kScene);
    write_text(*folder_ / "features.yaml", kFeatures);
    const std::string at = quoted(folder_->path());
    for (const std::string& command :
         {"simulate " + at + "/scene.yaml -o " + at + "/s",
          "reconstruct " + at + "/s/scan.yaml --rig " + at + "/s/truth/rig.yaml -o " + at +
              "/c.ply --profiles " + at + "/p.csv --height-map " + at + "/map.tif --raster 0.5",
          "measure " + at + "/p.csv --kind features --features " + at + "/features.yaml -o " + at +
              "/m.csv"}) {
      const CommandResult result = run_lightstripe(command + " --quiet");
      ASSERT_EQ(result.exit_code, 0) << command << "\n" << result.err;
    }
  }
  static void TearDownTestSuite() { delete folder_; }
  static TemporaryFolder* folder_;
};
TemporaryFolder* Steps::folder_ = nullptr;

TEST_F(Steps, FeatureToolsMeasureThemToAHundredth) {
  CsvReader rows(*folder_ / "m.csv", {"step", "step_sigma", "status"});
  int count = 0;
  while (rows.next()) {
    EXPECT_EQ(rows.text(2), "ok");
    EXPECT_NEAR(rows.number(0), 2, 0.01);
    EXPECT_LT(rows.number(1), 0.01);
    ++count;
  }
  EXPECT_EQ(count, 8);
}

// The table along the scan is one that people open as well.
TEST_F(Steps, BothTablesFollowTheStyle) {
  const std::string at = quoted(folder_->path());
  const CommandResult result =
      run_lightstripe("measure " + at + "/p.csv --kind features --features " + at + "/features.yaml -o " +
                      at + "/excel.csv --csv-style excel --quiet");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* name : {"excel.csv", "excel_along.csv"}) {
    const std::string table = read_file(*folder_ / name);
    EXPECT_EQ(table.substr(0, 3), "\xef\xbb\xbf") << name;
    EXPECT_NE(table.find(';'), std::string::npos) << name;
  }
}

// Per column of the map: mean of the upper tread less that of the lower one, 6 mm about the edge and 4 at the
// ends left out.
TEST_F(Steps, HeightMapShowsThemToAHundredth) {
  int width = 0, height = 0;
  const std::vector<float> map = read_float_tiff(*folder_ / "map.tif", &width, &height);
  ASSERT_GT(width, 20);
  ASSERT_GT(height, 140);
  const auto mean_of = [&](int column, int from, int to) {
    double sum = 0, known = 0;
    for (int row = from; row < to; ++row) {
      const float z = map[static_cast<std::size_t>(row * width + column)];
      if (std::isfinite(z)) sum += z, known += 1;
    }
    EXPECT_GT(known, 40) << column;
    return sum / known;
  };
  for (int column = 0; column < width; ++column)
    EXPECT_NEAR(mean_of(column, height / 2 + 12, height - 8) - mean_of(column, 8, height / 2 - 12), 2, 0.01)
        << column;
}

}  // namespace
}  // namespace lightstripe
