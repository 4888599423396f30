// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/nominal_outlines.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "core/error.h"
#include "test_paths.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector2d;
using ::testing::Contains;
using ::testing::HasSubstr;

double width_at(const Outline& outline, double v) {
  const auto left = first_hit(outline, {-1000, v}, {1, 0}, 0),
             right = first_hit(outline, {1000, v}, {-1, 0}, 0);
  return 2000 - left->s - right->s;
}

std::string message_of(const std::string& name) {
  try {
    read_nominal(name);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

fs::path written(const std::string& name, const std::string& text) {
  const fs::path path = fs::temp_directory_path() / ("lightstripe_" + name);
  std::ofstream(path) << text;
  return path;
}

// Published for 60E1 (EN 13674-1): 76.70 cm2, Ix 3038 cm4, Iy 512.3 cm4, centroid 80.9 above the base; each
// to its last digit.
TEST(Nominal60E1, HasThePublishedSectionProperties) {
  const SectionProperties section = section_properties(read_nominal("60E1"));
  EXPECT_NEAR(section.area / 1e2, 76.70, 0.005);
  EXPECT_NEAR(section.inertia_u / 1e4, 3038, 0.5);
  EXPECT_NEAR(section.inertia_v / 1e4, 512.3, 0.05);
  EXPECT_NEAR(section.centroid.y() + 172, 80.9, 0.05);
  EXPECT_NEAR(section.centroid.x(), 0, 1e-9);
}

TEST(Nominal60E1, HasThePublishedWidthsAndHeight) {
  const Outline rail = read_nominal("60E1");
  EXPECT_NEAR(width_at(rail, -14.0), 71.963, 0.0005);
  EXPECT_NEAR(width_at(rail, -14.3), 72.00, 0.001);
  EXPECT_NEAR(width_at(rail, -15.875), 72.157, 0.001);
  EXPECT_NEAR(width_at(rail, -95.0), 16.5, 1e-6);
  EXPECT_NEAR(width_at(rail, -165.0), 150, 1e-6);
  EXPECT_NEAR(first_hit(rail, {0, 10}, {0, -1}, 0)->s, 10, 1e-5);
  EXPECT_NEAR(first_hit(rail, {0, -200}, {0, 1}, 0)->s, 28, 1e-5);
}

TEST(Nominal60E1, RunsSmoothlyThroughTheHeadsTangentPoints) {
  const Outline rail = read_nominal("60E1");
  // The left half's crown, shoulder, corner and face follow each other first; 1e-5 mm of rounding on R13 is
  // 1e-6 rad.
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR((normal_at(rail.segments[i], 1) - normal_at(rail.segments[i + 1], 0)).norm(), 0, 1e-5) << i;
}

/// The points of a table in shared/reference; nothing where it is absent.
std::optional<std::vector<Vector2d>> reference_points(const std::string& name) {
  std::ifstream file(LIGHTSTRIPE_SOURCE_DIR "/../shared/reference/" + name);
  if (!file) return std::nullopt;
  std::vector<Vector2d> points;
  std::string line;
  while (std::getline(file, line)) {
    Vector2d p;
    char comma = 0;
    if (std::istringstream(line) >> p.x() >> comma >> p.y()) points.push_back(p);
  }
  return points;
}

double farthest_from(const Outline& outline, const std::vector<Vector2d>& points) {
  double worst = 0;
  for (const Vector2d& p : points) worst = std::max(worst, closest_point(outline, p).distance);
  return worst;
}

// Rounding of the table: 1e-5 mm in the tangent points, 1e-5 in each sample.
TEST(Nominal60E1, AgreesWithTheReferenceContour) {
  const auto points = reference_points("60E1_full_0p25mm.csv");
  if (!points) GTEST_SKIP() << "reference contour not present";
  EXPECT_GT(points->size(), 2000u);
  EXPECT_LT(farthest_from(read_nominal("60E1"), *points), 5e-5);
}

void expect_section(const std::string& name, double area_cm2, double inertia_u_cm4, double inertia_v_cm4,
                    double relative) {
  const SectionProperties section = section_properties(read_nominal(name));
  EXPECT_NEAR(section.area / 1e2 / area_cm2, 1, relative) << name;
  EXPECT_NEAR(section.inertia_u / 1e4 / inertia_u_cm4, 1, relative) << name;
  if (inertia_v_cm4 > 0) {
    EXPECT_NEAR(section.inertia_v / 1e4 / inertia_v_cm4, 1, relative) << name;
  }
}

// Published properties have four digits (2e-4); the fitted parts (fillets, corners) may add as much again.
TEST(NominalRails, HaveThePublishedSectionProperties) {
  expect_section("60E2", 76.48, 3022, 510.5, 6e-4);
  expect_section("54E1", 69.77, 2338, 0, 6e-4);
  expect_section("49E1", 63.193, 1830.9, 321.1, 6e-4);
}

TEST(NominalRails, HaveTheirPublishedWidthsAndHeights) {
  EXPECT_NEAR(width_at(read_nominal("54E1"), -14.1), 70.00, 0.002);
  EXPECT_NEAR(width_at(read_nominal("49E1"), -14.0), 66.998,
              0.003);  // on chords of 0.6 mm; the arcs give 67.000
  EXPECT_NEAR(width_at(read_nominal("60E2"), -14.3), 72.00, 0.002);
  EXPECT_NEAR(width_at(read_nominal("UIC60"), -14.3), 72.024, 0.002);
  const auto height = [](const char* name) {
    return -first_hit(read_nominal(name), {0, -300}, {0, 1}, 0)->s + 300;
  };
  EXPECT_NEAR(height("54E1"), 159, 1e-4);
  EXPECT_NEAR(height("49E1"), 149, 1e-4);
  EXPECT_NEAR(height("60E2"), 172, 1e-4);
}

// Largest normal distance between UIC60 and 60E1: 0.039 mm near u = 26 (two public UIC60 files).
TEST(NominalRails, Uic60DiffersFrom60E1ByAFewHundredthsNearTheShoulder) {
  const Outline rail = read_nominal("UIC60"), other = read_nominal("60E1");
  double worst = 0, where = 0;
  for (const OutlineSample& point : sample(rail, 0.5)) {
    const double distance = closest_point(other, point.position).distance;
    if (distance > worst) worst = distance, where = std::abs(point.position.x());
  }
  EXPECT_NEAR(worst, 0.039, 0.003);
  EXPECT_NEAR(where, 26, 3);
}

double top_at(const Outline& wheel, double u) { return 100 - first_hit(wheel, {u, 100}, {0, -1}, 0)->s; }
double face_at(const Outline& wheel, double v) { return 0 - first_hit(wheel, {0, v}, {-1, 0}, 0)->s; }

// Sh = tip over datum, Sd = back to face 10 over the datum, qR = face 10 over the datum to face 2 below the
// tip.
TEST(NominalWheel, S1002HasTheStandardsHeightThicknessAndQr) {
  const Outline wheel = read_nominal("S1002");
  EXPECT_NEAR(top_at(wheel, -55) - top_at(wheel, 0), 28.000, 5e-4);
  EXPECT_NEAR(face_at(wheel, 10) + 70, 32.500, 5e-4);
  EXPECT_NEAR(face_at(wheel, 10) - face_at(wheel, 26), 10.794, 1e-3);
}

TEST(NominalWheel, S1002AgreesWithTheReferenceContour) {
  const auto points = reference_points("S1002_h28_e32p5_0p25mm.csv");
  if (!points) GTEST_SKIP() << "reference contour not present";
  EXPECT_GT(points->size(), 700u);
  EXPECT_LT(farthest_from(read_nominal("S1002"), *points),
            1.5e-4);  // the zones' own steps of 1.2e-4 and the table's rounding
}

TEST(NominalWheel, ConesAreConesWithAFlangeOf28) {
  for (const double slope : {20.0, 40.0}) {
    const Outline wheel = read_nominal("cone" + std::to_string(static_cast<int>(slope)));
    EXPECT_NEAR(top_at(wheel, 40), -40 / slope, 1e-5);
    EXPECT_NEAR(top_at(wheel, -55), 28, 1e-5);
    EXPECT_NEAR(face_at(wheel, 10) + 70, 32.30, 0.005);
  }
}

TEST(NominalOutlines, EveryBuiltInOneSaysItsKind) {
  for (const std::string& name : nominal_names()) {
    const NominalProfile profile = read_nominal_profile(name);
    EXPECT_EQ(profile.name, name);
    EXPECT_TRUE(profile.kind == "rail" || profile.kind == "wheel") << name;
    EXPECT_GT(section_properties(profile.outline).area, 5000) << name;
  }
}

// Found by fuzzing.
TEST(NominalOutlines, AnOutlineThatEnclosesNothingIsRefused) {
  EXPECT_THAT(message_of(LIGHTSTRIPE_SOURCE_DIR "/tests/fuzz/seeds/nominal_outline/without_area.yaml"),
              HasSubstr("segments: enclose no area"));
}

TEST(NominalOutlines, UnknownNameListsTheBuiltInOnes) {
  EXPECT_THAT(nominal_names(), Contains("60E1"));
  EXPECT_THAT(message_of("61E1"), HasSubstr("60E1"));
}

TEST(NominalOutlines, FileAndBuiltInOutlineAreTheSame) {
  const Outline built_in = read_nominal("60E1");
  const Outline file = read_nominal(std::string(LIGHTSTRIPE_SOURCE_DIR) + "/configs/profiles/60E1.yaml");
  ASSERT_EQ(built_in.segments.size(), file.segments.size());
  for (std::size_t i = 0; i < file.segments.size(); ++i)
    EXPECT_EQ(built_in.segments[i].to, file.segments[i].to);
}

TEST(NominalOutlines, BadFilesAreRefusedWithFileAndEntry) {
  const std::string head = "format: lightstripe-outline/1\nstart: [0, 0]\nsegments:\n";
  const fs::path open = written("open.yaml", head + "  - {to: [1, 0]}\n  - {to: [1, 1]}\n");
  EXPECT_THAT(message_of(open.string()), HasSubstr("do not close"));
  const fs::path arc =
      written("arc.yaml", head + "  - {to: [1, 0]}\n  - {to: [2, 2], center: [1, 1]}\n  - {to: [0, 0]}\n");
  EXPECT_THAT(message_of(arc.string()), HasSubstr("segments.1: the arc's ends differ"));
  const fs::path bent =
      written("bent.yaml", head + "  - {to: [1, 0]}\n  - {to: [2, 3], polynomial: [-1, 1]}\n");
  EXPECT_THAT(message_of(bent.string()), HasSubstr("segments.1: the polynomial misses the end (2, 3)"));
  const fs::path format =
      written("format.yaml", "format: outline\nstart: [0, 0]\nsegments: [{to: [1, 1]}]\n");
  EXPECT_THAT(message_of(format.string()), HasSubstr("lightstripe-outline/1"));
}

}  // namespace
}  // namespace lightstripe
