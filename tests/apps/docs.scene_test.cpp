// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What the pages under docs/ show is true: commands run, links lead somewhere, quoted messages are ones the
// program gives.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "command_line.h"
#include "markdown.h"
#include "test_paths.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::HasSubstr;

const fs::path kSource = LIGHTSTRIPE_SOURCE_DIR;

std::vector<fs::path> pages() {
  std::vector<fs::path> found;
  for (const auto& entry : fs::recursive_directory_iterator(kSource / "docs"))
    if (entry.path().extension() == ".md") found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

/// All string literals of the program's sources, those that follow each other joined.
std::string messages_of_the_program() {
  std::string all;
  for (const std::string folder :
       {"src", "extraction", "calib", "reconstruct", "measure", "simulate", "pipeline", "report", "apps"})
    for (const auto& entry : fs::recursive_directory_iterator(kSource / folder))
      if (entry.path().extension() == ".cpp") all += text_of(entry.path());
  return std::regex_replace(all, std::regex(R"("\s*\n\s*")"), "");
}

TEST(Docs, LinksLeadToFiles) {
  for (const auto& page : pages()) expect_links_lead_to_files(page);
}

TEST(Docs, CommandsRunAsTheyStand) {
  const TemporaryFolder folder;
  prepare_own_rig(folder);
  for (const auto& page : pages()) expect_commands_run(page, folder);
  for (const std::string file : {"rig.yaml", "cloud.ply", "profiles.csv", "rehearsal/cloud.ply", "given.csv",
                                 "overlay/frame.png", "verify.csv", "wheel.csv", "wheel.html"})
    EXPECT_TRUE(fs::exists(folder / file)) << file;
}

TEST(Docs, ScriptsThatPagesNameAreThere) {
  const std::regex script("`(scripts/[a-z_.]+)");
  for (const auto& page : pages()) {
    const std::string text = text_of(page);
    for (std::sregex_iterator it(text.begin(), text.end(), script), end; it != end; ++it)
      EXPECT_TRUE(fs::exists(kSource / (*it)[1].str())) << page << ": " << (*it)[1];
  }
}

TEST(Docs, TheMethodsFunctionsStandInTheFilesThatItNames) {
  const std::regex row(R"(\| .+ \| `([a-z_/.]+)` \| `(\w+)` \|)");
  int rows = 0;
  for (const auto& line : lines_of(text_of(kSource / "docs/method.md"))) {
    std::smatch match;
    if (!std::regex_match(line, match, row)) continue;
    ++rows;
    EXPECT_TRUE(fs::exists(kSource / match[1].str())) << line;
    const std::string code = text_of(kSource / match[1].str());
    EXPECT_TRUE(std::regex_search(code, std::regex("\\b" + match[2].str() + "(\\(| final)"))) << line;
  }
  EXPECT_GE(rows, 30);
}

TEST(Docs, TheFilesThatTheMethodNamesAreInTheFolderOfTheirSection) {
  const std::regex heading(R"(## .*\(`([a-z]+/)`\))"), file(R"(`([a-z_0-9/]+\.(?:cpp|h))`)");
  fs::path folder;
  for (const auto& line : lines_of(text_of(kSource / "docs/method.md"))) {
    if (std::smatch match; line.starts_with("## "))
      folder = std::regex_match(line, match, heading) ? match[1].str() : "";
    for (std::sregex_iterator it(line.begin(), line.end(), file), end; it != end; ++it) {
      const std::string name = (*it)[1];
      EXPECT_TRUE(
          fs::exists(kSource / (name.find('/') == std::string::npos ? folder / name : fs::path(name))))
          << name;
    }
  }
}

TEST(Docs, TheCMakeLinesAreThoseOfTheTestedConsumer) {
  const auto tested = lines_of(text_of(kSource / "tests/consumer/CMakeLists.txt"));
  const auto shown = block_lines(text_of(kSource / "docs/how-to/use_as_a_library.md"), "cmake");
  EXPECT_EQ(shown.size(), 2U);
  for (const auto& line : shown) EXPECT_THAT(tested, Contains(line));
}

TEST(Docs, TroubleshootingQuotesMessagesOfTheProgram) {
  const std::string messages = messages_of_the_program();
  const std::regex row(R"(\| `([^`]+)` \| .* \|)");
  int quoted_messages = 0;
  for (const auto& line : lines_of(text_of(kSource / "docs/how-to/troubleshooting.md"))) {
    if (std::smatch match; std::regex_match(line, match, row)) {
      ++quoted_messages;
      EXPECT_THAT(messages.find(match[1].str()), ::testing::Ne(std::string::npos))
          << "no message says: " << match[1];
    }
  }
  EXPECT_GE(quoted_messages, 10);
}

}  // namespace
}  // namespace lightstripe
