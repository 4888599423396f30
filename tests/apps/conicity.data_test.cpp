// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The reference cases of EN 15302 / UIC 519 through the program, against the published columns.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "command_line.h"
#include "test_paths.h"

namespace lightstripe {
namespace {

const std::string kFolder = std::string(LIGHTSTRIPE_SOURCE_DIR) + "/../shared/reference/conicity/";

/// tan gamma_e by amplitude, tenths of a millimetre, out of the named column.
std::map<int, double> column(const std::string& file, std::size_t index) {
  std::ifstream in(file);
  std::map<int, double> out;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::stringstream cells(line);
    std::string cell;
    std::vector<std::string> row;
    while (std::getline(cells, cell, ',')) row.push_back(cell);
    if (row.size() > index && !row[index].empty())
      out[static_cast<int>(std::lround(10 * std::stod(row[0])))] = std::stod(row[index]);
  }
  return out;
}

struct Case {
  const char *name, *wheel, *gauge, *radius_difference;
};

class ConicityColumns : public ::testing::TestWithParam<Case> {};

TEST_P(ConicityColumns, AreMet) {
  if (!std::ifstream(kFolder + "rail_A.csv")) GTEST_SKIP() << "reference columns not present";
  const Case& one = GetParam();
  const std::string out = ::testing::TempDir() + "conicity_" + one.name + ".csv";
  const std::string command = std::string(LIGHTSTRIPE_COMMAND) + " conicity --quiet --wheel '" + kFolder +
                              "wheel_" + one.wheel + ".csv' --rail '" + kFolder + "rail_A.csv' --gauge " +
                              one.gauge + " --radius-difference " + one.radius_difference + " --draws 0 -o " +
                              out;
  ASSERT_EQ(std::system(command.c_str()), 0) << command;
  const auto ours = column(out, 2), reference = column(kFolder + "tan_gamma_e_" + one.name + ".csv", 1);
  EXPECT_NEAR(ours.at(30), reference.at(30), 0.003);
  double squares = 0;
  int count = 0;
  for (int tenths = 15; tenths <= 60; ++tenths)
    if (ours.contains(tenths)) squares += std::pow(ours.at(tenths) - reference.at(tenths), 2), ++count;
  EXPECT_GE(count, 35);
  EXPECT_LT(std::sqrt(squares / count), 0.005);
}

INSTANTIATE_TEST_SUITE_P(Uic519, ConicityColumns,
                         ::testing::Values(Case{"E1", "A", "1435", "0"}, Case{"E2", "B", "1435", "0"},
                                           Case{"E3", "H", "1435.16", "0"}, Case{"E4", "I", "1435", "0"},
                                           Case{"E5", "A", "1435", "-1"}, Case{"E7", "H", "1435.16", "-1"}),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace lightstripe
