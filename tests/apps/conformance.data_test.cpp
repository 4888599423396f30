// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// docs/conformance.md is what the program computes today, and what it promises is met.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include "command_line.h"
#include "test_paths.h"

namespace lightstripe {
namespace {

const std::string kSource = LIGHTSTRIPE_SOURCE_DIR;

std::string generated(const std::string& options, const std::filesystem::path& out) {
  const std::string command =
      std::string(LIGHTSTRIPE_COMMAND) + " generate conformance " + options + " -o '" + out.string() + "'";
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  return text_of(out);
}

int count_of(const std::string& text, const std::string& what) {
  int count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

TEST(ConformancePage, IsWhatTheProgramComputes) {
  const TemporaryFolder folder;
  const std::string page = text_of(kSource + "/docs/conformance.md");
  const std::string ours = generated("", folder / "page.md");
  EXPECT_EQ(page.substr(0, ours.size()), ours)
      << "run: lightstripe generate conformance --references ../shared -o "
         "docs/conformance.md";
  // CONTACT's places are an elastic patch's: the page says so. Everything else is met.
  EXPECT_EQ(count_of(ours, "| **no** |"), 0);
  EXPECT_GE(count_of(ours, "| yes |"), 12);
}

TEST(ConformancePage, HoldsTheReferenceFilesToo) {
  if (!std::ifstream(kSource + "/../shared/reference/conicity/rail_A.csv"))
    GTEST_SKIP() << "references not present";
  const TemporaryFolder folder;
  const std::string ours = generated("--references '" + kSource + "/../shared'", folder / "page.md");
  EXPECT_EQ(text_of(kSource + "/docs/conformance.md"), ours);
  EXPECT_EQ(count_of(ours, "| **no** |"), 0);
}

}  // namespace
}  // namespace lightstripe
