// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Sections that show a rail from one side, or its head alone: what can be known of them is measured, and the
// exit code asks whether what the user needs is among it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../measure/sections.h"
#include "command_line.h"
#include "io/csv_reader.h"
#include "io/nominal_outlines.h"

namespace lightstripe {
namespace {

using ::testing::HasSubstr;

class PartialSections : public ::testing::Test {
 protected:
  enum class Seen { kAll, kOneSide, kHead, kHalfHead };

  void write(Seen seen) {
    SectionRecipe recipe{.noise_mm = 0.01, .left = seen == Seen::kAll || seen == Seen::kHead};
    Section section = rail_section(read_nominal("60E1"), recipe);
    if (seen == Seen::kHead || seen == Seen::kHalfHead)
      std::erase_if(section, [](const SectionPoint& p) { return p.position.y() < -34; });
    std::string rows = "frame,travel,sensor,line,x,y,z,u,v,sigma\n";
    for (int frame = 0; frame < 2; ++frame)
      for (const ProfilePoint& p : profile_of(section).points)
        rows += fmt::format("{},{},{},{},0,{},{},{},{},0.01\n", frame, 2 * frame, p.sensor, p.line, p.u, p.v,
                            p.u, p.v);
    write_text(folder_ / "p.csv", rows);
  }
  CommandResult measure(const std::string& require) {
    return run_lightstripe("measure " + quoted(folder_ / "p.csv") + " --kind rail -o " +
                           quoted(folder_ / "m.csv") + (require.empty() ? "" : " --require " + require));
  }
  std::string cell(const std::string& name) {
    CsvReader rows(folder_ / "m.csv", {name});
    return rows.next() ? std::string(rows.text(0)) : "no row";
  }
  TemporaryFolder folder_;
};

TEST_F(PartialSections, TheExitCodeIsThreeOnlyWhereNothingThatIsNeededIsKnown) {
  struct Case {
    Seen seen;
    std::string require;
    int exit_code;
    std::string status;
  };
  const std::string head = "head only: without web or foot";
  for (const Case& one :
       std::vector<Case>{{Seen::kAll, "", 0, "ok"},
                         {Seen::kOneSide, "", 0, "head_width: head face -y not seen"},
                         {Seen::kOneSide, "vertical_wear,side_wear", 0, "ok"},
                         {Seen::kOneSide, "vertical_wear,head_width", 0, "head_width: head face -y not seen"},
                         {Seen::kOneSide, "head_width", 3, "head_width: head face -y not seen"},
                         {Seen::kHead, "", 0, head},
                         {Seen::kHead, "head_width", 0, "ok"},
                         {Seen::kHead, "head_width,vertical_wear", 0, "vertical_wear: " + head},
                         {Seen::kHead, "vertical_wear", 3, "vertical_wear: " + head},
                         {Seen::kHalfHead, "", 3, head}}) {
    write(one.seen);
    const auto result = measure(one.require);
    EXPECT_EQ(result.exit_code, one.exit_code) << one.status << " " << one.require << result.err;
    EXPECT_THAT(cell("status"), HasSubstr(one.status)) << one.require;
  }
  write(Seen::kHead);
  measure("");
  EXPECT_NEAR(std::stod(cell("head_width")), 71.963, 0.03);
  EXPECT_EQ(cell("vertical_wear"), "");
}

TEST_F(PartialSections, ARequiredQuantityThatIsNoneIsRefused) {
  write(Seen::kAll);
  const auto result = measure("vertical_waer");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err,
              HasSubstr("'vertical_waer' is no quantity of a rail; name one of vertical_wear, side_wear"));
}

}  // namespace
}  // namespace lightstripe
