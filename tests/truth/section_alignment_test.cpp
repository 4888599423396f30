// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "truth/section_alignment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/random.h"
#include "core/transform.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

void add_line(std::vector<Vector2d>& out, const Vector2d& a, const Vector2d& b) {
  for (int i = 0; i < 400; ++i) out.push_back(a + i / 400.0 * (b - a));
}

// Like one upper half of a rail: foot, web, underside of the head, gauge corner of 13 mm, crown, and
// mirrored.
std::vector<Vector2d> rail_like_shape() {
  std::vector<Vector2d> half;
  add_line(half, {75, 0}, {20, 20});
  add_line(half, {20, 20}, {8.25, 60});
  add_line(half, {8.25, 60}, {8.25, 120});
  add_line(half, {8.25, 120}, {36, 135});
  add_line(half, {36, 135}, {36, 157});
  for (int i = 0; i < 400; ++i) {
    const double a = i / 400.0 * 80 * kDegree;
    half.push_back({23 + 13 * std::cos(a), 157 + 13 * std::sin(a)});
  }
  add_line(half, half.back(), {0, 172});
  std::vector<Vector2d> all = half;
  for (auto it = half.rbegin(); it != half.rend(); ++it) all.emplace_back(-it->x(), it->y());
  return all;
}

// Points on the shape, moved away from it by `away`, with noise.
std::vector<Vector2d> measured_points(const std::vector<Vector2d>& shape, const SectionMove& away,
                                      double noise_mm, Random& random) {
  std::vector<Vector2d> points;
  for (int i = 0; i < 3000; ++i) {
    const auto k = static_cast<std::size_t>(random.uniform(0, double(shape.size() - 1)));
    const Vector2d p = shape[k] + random.uniform() * (shape[k + 1] - shape[k]);
    points.push_back(away * p + noise_mm * Vector2d(random.gaussian(), random.gaussian()));
  }
  return points;
}

TEST(AlignSection, UndoesAMoveOf1MmAndHalfADegreeWithoutNoise) {
  const auto shape = rail_like_shape();
  for (const double sign : {1.0, -1.0}) {
    Random random(5);
    const SectionMove away{sign * 0.5 * kDegree, {sign * 0.7, -0.7}};
    const auto measured = measured_points(shape, away, 0, random);
    const auto found = align_section(measured, shape);
    EXPECT_TRUE(found.converged);
    EXPECT_TRUE(found.determined);
    EXPECT_NEAR(found.shape_from_measured.angle_rad, -away.angle_rad, 1e-9);
    EXPECT_LT(found.rms_mm, 1e-7);
    EXPECT_EQ(found.far_fraction, 0);
    EXPECT_EQ(found.num_points, 3000);
    for (const Vector2d& p : shape) EXPECT_LT((found.shape_from_measured * (away * p) - p).norm(), 1e-6);
  }
}

TEST(AlignSection, RmsIsTheNoiseAcrossTheShape) {
  const auto shape = rail_like_shape();
  Random random(6);
  const auto found = align_section(measured_points(shape, {0.2 * kDegree, {0.4, 0.5}}, 0.02, random), shape);
  // One of two noise components lies across: 0.02 mm, known from 3000 points to 0.02 / sqrt(6000) = 1.3 %; 4
  // sigma.
  EXPECT_NEAR(found.rms_mm, 0.02, 0.02 * 0.052);
  EXPECT_NEAR(found.median_mm, 0.6745 * 0.02, 0.6745 * 0.02 * 0.1);
  // Place known to 0.02 / sqrt(3000) = 0.0004 mm a direction (some 2x for an uneven share of normals); 5
  // sigma.
  EXPECT_LT((found.shape_from_measured * (SectionMove{0.2 * kDegree, {0.4, 0.5}} * Vector2d(0, 100)) -
             Vector2d(0, 100))
                .norm(),
            0.004);
}

TEST(AlignSection, OutliersDoNotPullAndAreCounted) {
  const auto shape = rail_like_shape();
  Random random(7);
  auto measured = measured_points(shape, {0.3 * kDegree, {0.5, -0.6}}, 0.01, random);
  for (int i = 0; i < 150; ++i)
    measured[static_cast<std::size_t>(20 * i)] += Vector2d(0, 20 + 3 * random.uniform());
  const auto found = align_section(measured, shape);
  EXPECT_TRUE(found.converged);
  // Of the 150 moved ones, some may come to lie on another part of the shape.
  EXPECT_GT(found.far_fraction, 0.04);
  EXPECT_LE(found.far_fraction, 0.05);
  const Vector2d back =
      found.shape_from_measured * (SectionMove{0.3 * kDegree, {0.5, -0.6}} * Vector2d(0, 100));
  EXPECT_LT((back - Vector2d(0, 100)).norm(), 0.003);
}

TEST(AlignSection, OneSideOfTheShapeIsEnough) {
  const auto shape = rail_like_shape();
  Random random(8);
  const SectionMove away{-0.5 * kDegree, {-0.7, 0.7}};
  std::vector<Vector2d> one_side;
  for (const Vector2d& p : measured_points(shape, away, 0, random))
    if (p.x() > 5) one_side.push_back(p);
  const auto found = align_section(one_side, shape);
  EXPECT_TRUE(found.converged);
  EXPECT_LT(found.rms_mm, 1e-6);
  EXPECT_NEAR(found.shape_from_measured.angle_rad, -away.angle_rad, 1e-8);
}

TEST(AlignSection, HandComputedShiftOntoACorner) {
  // An L of two legs, measured 0.3 mm to the right and 0.1 mm too high.
  const std::vector<Vector2d> shape{{0, 50}, {0, 0}, {50, 0}};
  std::vector<Vector2d> measured;
  for (int i = 1; i < 20; ++i)
    measured.emplace_back(0.3, 0.1 + 2 * i), measured.emplace_back(0.3 + 2 * i, 0.1);
  const auto found = align_section(measured, shape);
  EXPECT_LT((found.shape_from_measured.translation - Vector2d(-0.3, -0.1)).norm(), 1e-8);
  EXPECT_NEAR(found.shape_from_measured.angle_rad, 0, 1e-10);
}

TEST(AlignSection, AlongAStraightLineNothingIsMoved) {
  const std::vector<Vector2d> shape{{0, 0}, {100, 0}};
  std::vector<Vector2d> measured;
  for (int i = 10; i < 80; ++i) measured.emplace_back(i, 0.5);
  const auto found = align_section(measured, shape);
  EXPECT_FALSE(found.determined);
  EXPECT_LT((found.shape_from_measured.translation - Vector2d(0, -0.5)).norm(), 1e-9);
}

TEST(AlignSection, PointsPastAnOpenEndDoNotPull) {
  // The legs end at 50; the last points of both lie past them, near enough to count as good ones.
  const std::vector<Vector2d> shape{{0, 50}, {0, 0}, {50, 0}};
  std::vector<Vector2d> measured;
  for (int i = 1; i < 25; ++i) measured.emplace_back(0, 2 * i), measured.emplace_back(2 * i, 0);
  for (int i = 1; i < 9; ++i)
    measured.emplace_back(50 + 0.01 * i, 0), measured.emplace_back(0, 50 + 0.01 * i);
  const auto found = align_section(measured, shape);
  EXPECT_TRUE(found.converged);
  EXPECT_LT(found.shape_from_measured.translation.norm(), 1e-9);
}

TEST(AlignSection, NoCounterpartAtAllIsReported) {
  const std::vector<Vector2d> shape{{0, 0}, {100, 0}};
  const std::vector<Vector2d> measured{{0, 50}, {10, 50}, {20, 51}};
  const auto found = align_section(measured, shape);
  EXPECT_EQ(found.num_points, 0);
  EXPECT_EQ(found.far_fraction, 1);
  EXPECT_FALSE(found.determined);
}

}  // namespace
}  // namespace lightstripe
