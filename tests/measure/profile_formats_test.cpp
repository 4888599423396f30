// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/profile_formats.h"

#include <gmock/gmock.h>

#include <sstream>

#include "core/error.h"
#include "io/nominal_outlines.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using ::testing::HasSubstr;

RecordedProfile recorded(const std::string& nominal, ObjectKind kind) {
  RecordedProfile profile;
  profile.kind = kind;
  for (const OutlineSample& point : sample(read_nominal(nominal), 0.5))
    if (point.position.y() > -30) profile.points.push_back(point.position);
  return profile;
}

std::string message_of(const std::string& text, bool simpack = false) {
  std::istringstream in(text);
  try {
    simpack ? read_simpack(in, "file") : read_miniprof(in, "file", ObjectKind::kRail);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

void expect_same_points(const RecordedProfile& a, const RecordedProfile& b) {
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i) EXPECT_LT((a.points[i] - b.points[i]).norm(), 2e-5) << i;
}

TEST(ProfileFormats, ComeBackAsTheyWereWritten) {
  for (const ObjectKind kind : {ObjectKind::kRail, ObjectKind::kWheel}) {
    RecordedProfile profile = recorded(kind == ObjectKind::kRail ? "60E1" : "S1002", kind);
    profile.header["Line"] = "12";
    std::stringstream mini, simpack;
    write_miniprof(mini, profile);
    write_simpack(simpack, profile);
    const RecordedProfile back = read_miniprof(mini, "a", kind), other = read_simpack(simpack, "b");
    expect_same_points(profile, back);
    expect_same_points(profile, other);
    EXPECT_EQ(back.header.at("Line"), "12");
    EXPECT_EQ(other.kind, kind);
  }
}

TEST(ProfileFormats, MiniProfOrientationIsFound) {
  const RecordedProfile wheel = recorded("S1002", ObjectKind::kWheel);
  for (const double x_sign : {1.0, -1.0})
    for (const double y_sign : {1.0, -1.0}) {
      std::ostringstream text;
      text << "Sd=32.5\n\n";
      for (const Vector2d& p : wheel.points) text << x_sign * (p.x() + 70) << ' ' << y_sign * p.y() << "\n";
      std::istringstream in(text.str());
      const RecordedProfile back = read_miniprof(in, "w", ObjectKind::kWheel);
      for (std::size_t i = 0; i < back.points.size(); ++i)
        ASSERT_LT((back.points[i] - wheel.points[i]).norm(), 1e-3);
      EXPECT_EQ(back.number("Sd"), 32.5);
    }
}

TEST(ProfileFormats, OlderMiniProfStyleIsRead) {
  std::string text = "MINIPROF wheel\nStock.......: 4711\n32.58 37.11 14.71  (Sd/Sh/qR)\n\n";
  for (int i = 0; i <= 28; ++i)
    text += std::to_string(5 * i) + " " + std::to_string(i < 6 ? 20 : 0) + " 0.1\n";
  std::istringstream in(text);
  const RecordedProfile wheel = read_miniprof(in, "old", ObjectKind::kWheel);
  EXPECT_EQ(wheel.header.at("Stock"), "4711");
  EXPECT_NEAR(*wheel.number("qR"), 14.71, 1e-9);
  EXPECT_EQ(wheel.points.size(), 29u);
}

TEST(ProfileFormats, OnlyTheFirstPointSectionOfAMultiPartFileIsRead) {
  std::string text = "[FileInfo]\nDate=1\n[Profile1Points]\n";
  for (int i = -10; i <= 10; ++i) text += std::to_string(3 * i) + ", " + std::to_string(-i * i) + "\n";
  text += "[Profile2Points]\n1 1\n2 2\n";
  std::istringstream in(text);
  EXPECT_EQ(read_miniprof(in, "mpt", ObjectKind::kRail).points.size(), 21u);
}

TEST(ProfileFormats, CommentsAndUnitsOfSimpackAreHeeded) {
  std::string text =
      "header.begin\n type = 0 ! rail\nheader.end\nspline.begin\n units.len.f = 1.\n point.begin\n! 9 9\n";
  for (int i = -10; i <= 10; ++i)
    text += std::to_string(0.003 * i) + " " + std::to_string(0.0001 * i * i) + "\n";
  text += " point.end\nspline.end\n";
  std::istringstream in(text);
  const RecordedProfile rail = read_simpack(in, "m");
  ASSERT_EQ(rail.points.size(), 21u);
  EXPECT_NEAR(rail.points[0].x(), -30, 1e-9);
  EXPECT_NEAR(rail.points[0].y(), -10, 1e-9);  // z was down
}

TEST(ProfileFormats, WhatIsNoProfileIsRefused) {
  EXPECT_THAT(message_of(""), HasSubstr("only 0 points"));
  EXPECT_THAT(message_of("a=b\n\n1 2\n3 4\n"), HasSubstr("only 2 points"));
  EXPECT_THAT(message_of(std::string("1 2\n\0\n", 6)), HasSubstr("no text file"));
  EXPECT_THAT(message_of(std::string(20000, '1')), HasSubstr("no text file"));
  EXPECT_THAT(message_of("1 2\n1e9 3\n"), HasSubstr("100 m"));
  EXPECT_THAT(message_of("1 2\n1 2\nrubbish\n"), HasSubstr("no point"));
  EXPECT_THAT(message_of("1 nan\n"), HasSubstr("only 0 points"));
  EXPECT_THAT(message_of("point.begin\nx y\n", true), HasSubstr("no point in 'x y'"));
  std::string shifted = "shift.y = 3\npoint.begin\n";
  for (int i = 0; i < 12; ++i) shifted += std::to_string(i) + " 0\n";
  EXPECT_THAT(message_of(shifted + "point.end\n", true), HasSubstr("shift.y"));
}

TEST(ProfileFormats, AreTakenByTheNamesEnd) {
  EXPECT_EQ(profile_format("a/avg_HR.BAN"), ProfileFormat::kMiniProf);
  EXPECT_EQ(profile_format("x.whl"), ProfileFormat::kMiniProf);
  EXPECT_EQ(profile_format("x.prr"), ProfileFormat::kSimpack);
  EXPECT_FALSE(profile_format("profiles.csv"));
  EXPECT_FALSE(profile_format(""));
}

/// The rows of a head, as both formats write them.
std::string rows_of_head(const std::string& behind_each = "") {
  std::string rows;
  for (int i = -20; i <= 20; ++i)
    rows += std::to_string(i) + ".5 " + std::to_string(i * i / -20) + ".25" + behind_each + "\n";
  return rows;
}

std::size_t points_of(const std::string& text, bool simpack = false) {
  std::istringstream in(text);
  return (simpack ? read_simpack(in, "file") : read_miniprof(in, "file", ObjectKind::kRail)).points.size();
}

TEST(ProfileFormats, RemarksRowsCommentedOutAndCtrlZAreNoPoints) {
  EXPECT_EQ(points_of("W1=1\n\n" + rows_of_head() + "\"3.0 4.0\n%5 6\n! 7 8\n# 1\n1.0 2.0  joint here\n"),
            42u);
  EXPECT_EQ(points_of("W1=1\n\n" + rows_of_head() + "\x1a"), 41u);
  EXPECT_EQ(points_of("W1=1\n\n" + rows_of_head() + "\x1a\nrest of a sector"), 41u);
  const std::string head = "units.len.f = 1000 ! mm\npoint.begin\n", end = "point.end\n";
  EXPECT_EQ(
      points_of(head + rows_of_head() + "%1 2\n! 3 4\n5 6 1.0 remark\n7 8 ! remark\n" + end + "\x1a", true),
      43u);
  EXPECT_EQ(points_of(head + rows_of_head(" 1.0 'left side'") + end, true), 41u);
}

TEST(ProfileFormats, OnlyTheFirstProfileOfAnMptIsRead) {
  for (const std::string& behind : {"[Profile2Info]\nProgramName=own\n\n[Profile2Points]\n" + rows_of_head(),
                                    std::string("[Profile1Results]\nW1=0.80\n"), std::string()}) {
    std::istringstream in("[FileInfo]\nProgramName=own\n\n[Profile1Points]\n" + rows_of_head() + "\n" +
                          behind);
    const RecordedProfile profile = read_miniprof(in, "two.mpt", ObjectKind::kRail);
    EXPECT_EQ(profile.points.size(), 41u) << behind;
    EXPECT_EQ(profile.further_profiles, behind.find("Profile2") == std::string::npos ? 0 : 1);
  }
}

TEST(ProfileFormats, DecimalCommasAreNamedAsSuch) {
  for (const char* const row : {"12,5 -3,75\n", "-12,5\t3,75\t1\n", "12,5;3,75\n"}) {
    std::string rows;
    for (int i = 0; i < 20; ++i) rows += row;
    EXPECT_THAT(message_of("W1=1\n\n" + rows), HasSubstr("has decimal commas: '"));
    EXPECT_THAT(message_of("point.begin\n" + rows + "point.end\n", true), HasSubstr("has decimal commas: '"));
  }
  EXPECT_EQ(points_of("A=1\n\n" + rows_of_head() + "1,2\n1.0, 2.0\n3.0,4.0,5\n"), 44u)
      << "commas between numbers";
}

TEST(ProfileFormats, AWheelMayCountFromItsTreadDatum) {
  const RecordedProfile wheel = recorded("S1002", ObjectKind::kWheel);
  for (const double x_sign : {1.0, -1.0})
    for (const double y_sign : {1.0, -1.0}) {
      std::ostringstream text;
      text << "type = 1\npoint.begin\n";
      for (const Vector2d& p : wheel.points) text << x_sign * p.x() << ' ' << y_sign * p.y() << "\n";
      text << "point.end\n";
      std::istringstream in(text.str());
      const RecordedProfile back = read_simpack(in, "w");
      for (std::size_t i = 0; i < back.points.size(); ++i)
        ASSERT_LT((back.points[i] - wheel.points[i]).norm(), 1e-3) << x_sign << y_sign;
    }
}

}  // namespace
}  // namespace lightstripe
