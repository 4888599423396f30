// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A worn rail under lamps with the laser off: its edges, gleams and spots are no lines, whatever they are
// made of. With the laser on the same rail has its line.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "command_line.h"
#include "io/csv_reader.h"

namespace lightstripe {
namespace {

struct Rail {
  std::string name;
  double ambient = 0;  ///< grey level of white
  double specular = 0, texture = 0;
  int reflections = 0;
};

class LaserOff : public ::testing::TestWithParam<Rail> {
 protected:
  /// Renders two frames of each of the demo's sensors and looks for lines in them.
  CommandResult look(double brightness) {
    const Rail& rail = GetParam();
    std::string sensors = run_lightstripe("simulate --print-scene").out;
    sensors = sensors.substr(sensors.find("sensors:"));
    sensors = sensors.substr(0, sensors.find("\nimaging:") + 1);
    const std::string usual = "brightness: 420";
    for (std::size_t at = 0; (at = sensors.find(usual, at)) != std::string::npos;)
      sensors.replace(at, usual.size(), fmt::format("brightness: {}", brightness));
    write_text(folder_ / "scene.yaml",
               fmt::format("{}imaging: {{scan_ambient: {}}}\nboards: {{count: 0}}\nmotion: {{positions: 0}}\n"
                           "scan: {{frames: 2}}\nreflections: {{per_frame: {}}}\n"
                           "rail: {{profile: 60E1, vertical_wear_mm: [2, 2], material: {{specular: {}, "
                           "shininess: 30, texture: {{contrast: {}}}}}}}\n",
                           sensors, rail.ambient, rail.reflections, rail.specular, rail.texture));
    const std::string at = quoted(folder_.path());
    const CommandResult drawn = run_lightstripe("simulate " + at + "/scene.yaml -o " + at + "/s --quiet");
    EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
    return run_lightstripe("extract " + at + "/s/scan/*/*.png -o " + at + "/stripes.csv");
  }
  TemporaryFolder folder_;
};

TEST_P(LaserOff, GivesNoLine) {
  const CommandResult result = look(1e-3);
  EXPECT_EQ(result.exit_code, 3) << result.out;
  EXPECT_THAT(result.err, ::testing::HasSubstr("no stripe was found in any image"));
}

TEST_P(LaserOff, TheSameRailWithTheLaserOnHasItsLine) {
  ASSERT_EQ(look(600).exit_code, 0);
  CsvReader rows(folder_ / "stripes.csv", {"x"});
  int points = 0;
  while (rows.next()) ++points;
  EXPECT_GT(points, 4 * 300);
}

INSTANTIATE_TEST_SUITE_P(
    Rails, LaserOff,
    ::testing::Values(Rail{.name = "Dull", .ambient = 120},
                      Rail{.name = "Shiny", .ambient = 120, .specular = 0.6},
                      Rail{.name = "Rusty", .ambient = 160, .texture = 0.4},
                      Rail{.name = "RustyAndShiny", .ambient = 160, .specular = 0.4, .texture = 0.3},
                      Rail{.name = "Lamps", .ambient = 60, .reflections = 3}),
    [](const auto& rail) { return rail.param.name; });

}  // namespace
}  // namespace lightstripe
