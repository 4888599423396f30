// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/tables.h"

#include <gmock/gmock.h>

#include <chrono>

#include "core/random.h"
#include "io/atomic_file.h"
#include "tests/io/temp_folder.h"

namespace lightstripe {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

std::map<std::int64_t, double> travel_of(const std::string& text) {
  const TempFolder folder;
  return read_frame_travel(folder.write("t.csv", text), "travel_mm");
}

/// The message behind the file's folder, which differs from run to run.
template <class Run>
std::string complaint(const Run& run) {
  const std::string message = error_of(run);
  const std::size_t at = message.find("t.csv");
  return at == std::string::npos ? message : message.substr(at);
}

std::string travel_complaint(const std::string& text) {
  return complaint([&] { travel_of(text); });
}

TEST(FrameTravel, IsFoundByColumnNamesWhateverTheirOrder) {
  EXPECT_THAT(travel_of("frame,travel_mm\n0,0\n1,2.5\n"), ElementsAre(Pair(0, 0.0), Pair(1, 2.5)));
  EXPECT_THAT(travel_of("note,travel_mm,frame\n\"a, b\",-1e1,7\n"), ElementsAre(Pair(7, -10.0)));
}

TEST(FrameTravel, TakesWindowsLinesCommentsBlanksAndAByteOrderMark) {
  EXPECT_THAT(
      travel_of("\xef\xbb\xbf# made by hand\r\nframe, travel_mm\r\n\r\n0 , 1\r\n# more\r\n 1,\t2\r\n"),
      ElementsAre(Pair(0, 1.0), Pair(1, 2.0)));
  EXPECT_THAT(travel_of("frame,travel_mm\n5,1"), ElementsAre(Pair(5, 1.0)));
}

TEST(FrameTravel, ARowWithoutAReadingIsLeftOut) {
  EXPECT_THAT(travel_of("frame,travel_mm\n0,1\n1,\n2,3\n"), ElementsAre(Pair(0, 1.0), Pair(2, 3.0)));
}

TEST(FrameTravel, NamesTheLineOfABadRow) {
  EXPECT_EQ(travel_complaint("frame,travel_mm\n0,1\n1\n"),
            "t.csv:3: has 1 cells, the first line 2; complete the row");
  EXPECT_THAT(travel_complaint("frame,travel_mm\n0,1,2\n"), HasSubstr("t.csv:2: has 3 cells"));
  EXPECT_EQ(travel_complaint("frame,travel_mm\n# x\n0,nan\n"),
            "t.csv:3: travel_mm is 'nan'; give a finite number with a decimal point");
  EXPECT_THAT(travel_complaint("frame,travel_mm\n0,\n"), HasSubstr("has no rows with a position"));
  EXPECT_THAT(travel_complaint("frame,travel_mm\n0.5,1\n"), HasSubstr("frame is '0.5'; give a whole number"));
  EXPECT_EQ(travel_complaint("frame,travel_mm\n3,1\n3,1\n"), "t.csv:3: frame 3 is given twice; keep one row");
  EXPECT_THAT(travel_complaint("frame,travel_mm\n\"0,1\n"), HasSubstr("t.csv:2: a quoted cell does not end"));
}

TEST(FrameTravel, ExplainsAWrongHeader) {
  EXPECT_EQ(travel_complaint("frame,angle_deg\n0,1\n"),
            "t.csv:1: no column 'travel_mm'; the first line has to name the columns frame,travel_mm");
  EXPECT_THAT(travel_complaint("frame;travel_mm\n0;1\n"), HasSubstr("separate the columns by commas"));
  EXPECT_THAT(travel_complaint("frame,travel_mm,frame\n0,1,0\n"), HasSubstr("two columns 'frame'"));
  EXPECT_THAT(travel_complaint(""), HasSubstr("t.csv: is empty"));
  EXPECT_THAT(travel_complaint("frame,travel_mm\n"), HasSubstr("t.csv: has no rows"));
}

TEST(FrameTravel, RefusesWhatIsNoText) {
  EXPECT_THAT(travel_complaint(std::string("frame,travel_mm\n0\0,1\n", 21)),
              HasSubstr("t.csv:2: is not text"));
  EXPECT_THAT(travel_complaint(std::string(100'000, 'x')), HasSubstr("t.csv:1: is longer than 65536"));
}

TEST(ImageTravel, GoesByFileName) {
  const TempFolder folder;
  const auto file = folder.write("t.csv", "image,angle_deg\n\"a \"\"b\"\".png\",10\nc d.png,-20.5\n");
  EXPECT_THAT(read_image_travel(file, "angle_deg"),
              ElementsAre(Pair("a \"b\".png", 10.0), Pair("c d.png", -20.5)));
  folder.write("t.csv", "image,angle_deg\na.png,1\na.png,1\n");
  EXPECT_EQ(complaint([&] { read_image_travel(file, "angle_deg"); }),
            "t.csv:3: image 'a.png' is given twice; keep one row");
}

TEST(Poses, AreReadWithUnitQuaternions) {
  const TempFolder folder;
  const auto file = folder.write("t.csv", "frame,qw,qx,qy,qz,x,y,z\n4,0.7071,0,0,0.7071,1,2,3\n");
  const auto poses = read_poses(file);
  ASSERT_EQ(poses.count(4), 1U);
  EXPECT_NEAR(poses.at(4).rotation.norm(), 1, 1e-15);
  // A quarter turn about z takes x to y.
  EXPECT_LT((poses.at(4) * Eigen::Vector3d::UnitX() - Eigen::Vector3d(1, 3, 3)).norm(), 1e-12);
  folder.write("t.csv", "frame,qw,qx,qy,qz,x,y,z\n4,0.7,0,0,0.7,1,2,3\n");
  EXPECT_EQ(complaint([&] { read_poses(file); }),
            "t.csv:2: the quaternion has not unit length; give qw,qx,qy,qz of a rotation");
  folder.write("t.csv", "frame,qw,qx,qy,qz,x,y,z\n4,0,0,0,0,1,2,3\n");
  EXPECT_THAT(complaint([&] { read_poses(file); }), HasSubstr("unit length"));
}

TEST(Stripes, AreOneRowAPoint) {
  Stripe stripe;
  stripe.points.push_back({1.0, 2.123456, 0.6, -0.8, 6.25, 12.5, 0.0123456, 100, 0});
  stripe.points.push_back(stripe.points.back());
  stripe.points.back().flags = kStripeBridged | kStripeSaturated | kStripeAsymmetric;
  std::string out(kStripesHeader);
  append_stripes(out, "a, b.png", {Stripe{}, stripe});
  EXPECT_EQ(out,
            "image,line,x,y,normal_x,normal_y,width,strength,sigma_px,flags\n"
            "\"a, b.png\",1,1,2.12346,0.6,-0.8,6.25,12.5,0.01235,\n"
            "\"a, b.png\",1,1,2.12346,0.6,-0.8,6.25,12.5,0.01235,bridged;saturated;asymmetric\n");
}

Profile random_profile(std::int64_t frame, int points) {
  Random random(5, static_cast<std::uint64_t>(frame));
  Profile profile;
  profile.frame = frame;
  profile.travel = 2.5 * static_cast<double>(frame);
  for (int i = 0; i < points; ++i) {
    ProfilePoint point;
    for (int axis = 0; axis < 3; ++axis) point.position[axis] = random.uniform(-500, 500);
    point.u = point.position.y();
    point.v = point.position.z();
    point.sigma_mm = random.uniform(0, 0.02);
    point.sensor = i % 2;
    point.line = i % 3;
    profile.points.push_back(point);
  }
  return profile;
}

TEST(Profiles, ReadBackWithinTheDigitsWritten) {
  const std::vector<Profile> before = {random_profile(3, 100), random_profile(1, 50)};
  std::string text(kProfilesHeader);
  for (const Profile& profile : before) append_profile(text, profile);
  const TempFolder folder;
  const auto after = read_profiles(folder.write("p.csv", text));
  ASSERT_EQ(after.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(after[i].frame, before[i].frame);
    EXPECT_EQ(after[i].travel, before[i].travel);
    ASSERT_EQ(after[i].points.size(), before[i].points.size());
    for (std::size_t k = 0; k < after[i].points.size(); ++k) {
      const ProfilePoint &a = after[i].points[k], &b = before[i].points[k];
      EXPECT_LT((a.position - b.position).cwiseAbs().maxCoeff(), 0.50001e-5);  // half of the last digit
      EXPECT_NEAR(a.u, b.u, 0.50001e-5);
      EXPECT_NEAR(a.sigma_mm, b.sigma_mm, 0.50001e-6);
      EXPECT_EQ(a.sensor, b.sensor);
      EXPECT_EQ(a.line, b.line);
    }
  }
}

TEST(Profiles, RowsOfAFrameAreCollectedWhereverTheyStand) {
  const TempFolder folder;
  const auto file = folder.write("t.csv",
                                 "frame,travel,sensor,line,x,y,z,u,v,sigma\n"
                                 "0,0,0,0,1,2,3,2,3,0.01\n1,5,0,0,1,2,3,2,3,0.01\n0,0,1,0,7,2,3,2,3,0.01\n");
  const auto profiles = read_profiles(file);
  ASSERT_EQ(profiles.size(), 2U);
  ASSERT_EQ(profiles[0].points.size(), 2U);
  EXPECT_EQ(profiles[0].points[1].position.x(), 7);
  EXPECT_EQ(profiles[1].travel, 5);
}

TEST(Profiles, RefuseTwoTravelsOfAFrameAndNegativeCounts) {
  const TempFolder folder;
  const std::string header(kProfilesHeader);
  const auto bad = [&](const std::string& rows) {
    const auto file = folder.write("t.csv", header + rows);
    return complaint([&] { read_profiles(file); });
  };
  EXPECT_THAT(bad("0,0,0,0,1,2,3,2,3,0\n0,1,0,0,1,2,3,2,3,0\n"),
              HasSubstr("t.csv:3: frame 0 has another travel"));
  EXPECT_THAT(bad("0,0,-1,0,1,2,3,2,3,0\n"), HasSubstr("t.csv:2: sensor and line are counted from 0"));
  EXPECT_THAT(bad("0,0,0,0,1,2,3,2,3,-1\n"), HasSubstr("t.csv:2: sigma is negative"));
  EXPECT_THAT(bad("0,0,0,0,1,inf,3,2,3,0\n"), HasSubstr("t.csv:2: y is 'inf'"));
  EXPECT_EQ(bad(""), "no Error");
}

}  // namespace
}  // namespace lightstripe
