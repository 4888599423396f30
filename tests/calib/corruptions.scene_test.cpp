// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Good sessions with 60 random faults in them: none may give a rig that is worse than it says.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numeric>

#include "calib/adjust/session_views.h"
#include "calib/calibrate_rig.h"
#include "section_error.h"

namespace lightstripe {
namespace {

using testing::observe;
using testing::rail_rig;

/// A session, and what was done to it.
struct Corrupted {
  CalibrationObservations observations;
  std::string what;
};

std::size_t pick(Random& random, std::size_t n) {
  return std::min(n - 1, static_cast<std::size_t>(random.uniform() * static_cast<double>(n)));
}

/// Some of n indices, at least one, in random order.
std::vector<std::size_t> some(Random& random, std::size_t n) {
  std::vector<std::size_t> all(n);
  std::iota(all.begin(), all.end(), std::size_t{0});
  for (std::size_t i = n; i > 1; --i) std::swap(all[i - 1], all[pick(random, i)]);
  all.resize(1 + pick(random, n));
  return all;
}

void shift_lasers(Corrupted& session, Random& random) {
  const std::size_t by = 1 + pick(random, 3);
  for (auto& sensor : session.observations.sensors) {
    auto views = sensor.views;
    for (std::size_t i = 0; i < views.size(); ++i)
      sensor.views[i].stripes = views[(i + by) % views.size()].stripes;
  }
  session.what = fmt::format("laser pictures shifted by {}", by);
}

void reverse_lasers(Corrupted& session, Random&) {
  for (auto& sensor : session.observations.sensors) {
    auto views = sensor.views;
    for (std::size_t i = 0; i < views.size(); ++i)
      sensor.views[i].stripes = views[views.size() - 1 - i].stripes;
  }
  session.what = "laser pictures reversed";
}

void mix_lasers(Corrupted& session, Random& random) {
  auto& views = session.observations.sensors[0].views;
  const auto chosen = some(random, views.size());
  auto first = views[chosen.front()].stripes;
  for (std::size_t i = 0; i + 1 < chosen.size(); ++i) views[chosen[i]].stripes = views[chosen[i + 1]].stripes;
  views[chosen.back()].stripes = first;
  session.what = fmt::format("{} laser pictures mixed up", chosen.size());
}

/// Pixels as a turned or mirrored picture shows them.
void flip(BoardView& view, const Target& target, bool x, bool y) {
  const auto move = [&](double& px, double& py) {
    if (x) px = 959 - px;
    if (y) py = 699 - py;
  };
  for (auto& corner : view.corners) move(corner.x(), corner.y());
  for (auto& stripe : view.stripes)
    for (auto& point : stripe) {
      move(point.x, point.y);
      if (x) point.normal_x = -point.normal_x;
      if (y) point.normal_y = -point.normal_y;
    }
  if (x != y)  // the detection lists a mirrored board right-handed
    for (auto row = view.corners.begin(); row != view.corners.end(); row += target.columns)
      std::reverse(row, row + target.columns);
}

void flip_pictures(Corrupted& session, Random& random) {
  const bool x = random.uniform() < 0.7, y = !x || random.uniform() < 0.6;
  const auto chosen = some(random, session.observations.sensors[0].views.size());
  for (const auto i : chosen)
    flip(session.observations.sensors[0].views[i], session.observations.target, x, y);
  session.what = fmt::format("{} pictures {}", chosen.size(), x && y ? "turned" : "mirrored");
}

/// Boards of other squares are seen like boards farther or nearer: only the stripe tells.
void mix_boards(Corrupted& session, Random& random, const testing::SyntheticRig& truth,
                const testing::SessionOptions& options) {
  const double scale = random.uniform() < 0.5 ? 0.8 : 1.25;
  auto poses = testing::board_poses(truth, options);
  const auto chosen = some(random, poses.size());
  testing::SyntheticRig other = truth;
  other.target.pitch_x *= scale;
  other.target.pitch_y *= scale;
  if (2 * chosen.size() > poses.size())  // the board at hand is the other one, and moves with the travel too
    session.observations.motion = testing::observe_travel(other, options, random);
  for (const auto i : chosen)
    for (std::size_t s = 0; s < truth.sensors.size(); ++s) {
      auto& view = session.observations.sensors[s].views[i];
      const Rigid3 pose = truth.sensors[s].cam_from_first * poses[i];
      view.corners = testing::seen_corners(other.target, truth.sensors[s].camera, pose);
      view.stripes = {testing::seen_stripe(other.target, truth.sensors[s], pose, options.stripe_width_px)};
      testing::add_noise(view, options, random);
    }
  session.what = fmt::format("{} boards with squares of {} mm", chosen.size(), other.target.pitch_x);
}

void change_unit(Corrupted& session, Random& random) {
  constexpr std::array<double, 5> kFactors{1e-3, 0.1, 1 / 25.4, 10, 1000};
  const double factor = kFactors[pick(random, kFactors.size())];
  session.observations.target.pitch_x *= factor;
  session.observations.target.pitch_y *= factor;
  if (random.uniform() < 0.5) session.observations.motion.reset();
  session.what =
      fmt::format("squares times {:.3g}{}", factor, session.observations.motion ? "" : ", no motion");
}

void remove_views(Corrupted& session, Random& random) {
  for (auto& sensor : session.observations.sensors) {
    for (const auto i : some(random, sensor.views.size()))
      random.uniform() < 0.5 ? sensor.views[i].stripes.clear() : sensor.views[i].corners.clear();
    std::erase_if(sensor.views, [](const auto& view) { return view.corners.empty(); });
  }
  session.what = "pictures missing";
}

void swap_poses(Corrupted& session, Random& random) {
  auto& views = session.observations.sensors.back().views;
  const auto chosen = some(random, views.size());
  const auto first = views[chosen.front()].pose;
  for (std::size_t i = 0; i + 1 < chosen.size(); ++i) views[chosen[i]].pose = views[chosen[i + 1]].pose;
  views[chosen.back()].pose = first;
  session.what = fmt::format("{} poses of the last sensor renamed", chosen.size());
}

void duplicate_views(Corrupted& session, Random& random) {
  auto& views = session.observations.sensors[pick(random, session.observations.sensors.size())].views;
  const auto chosen = some(random, views.size());
  const bool laser_only = random.uniform() < 0.5;
  for (const auto i : chosen) {
    const auto& from = views[chosen.front()];
    if (!laser_only) views[i].corners = from.corners;
    views[i].stripes = from.stripes;
  }
  session.what = fmt::format("{} copies of one {}", chosen.size(), laser_only ? "laser picture" : "pair");
}

void mix_travel(Corrupted& session, Random& random) {
  auto& travel = session.observations.motion->travel;
  const auto chosen = some(random, travel.size());
  for (std::size_t i = 0; i + 1 < chosen.size(); ++i) std::swap(travel[chosen[i]], travel[chosen[i + 1]]);
  session.what = fmt::format("{} positions of travel mixed up", chosen.size());
}

constexpr int kFaults = 10;

void corrupt(Corrupted& session, int fault, Random& random, const testing::SyntheticRig& truth,
             const testing::SessionOptions& options) {
  switch (fault) {
    case 0:
      return shift_lasers(session, random);
    case 1:
      return reverse_lasers(session, random);
    case 2:
      return mix_lasers(session, random);
    case 3:
      return flip_pictures(session, random);
    case 4:
      return mix_boards(session, random, truth, options);
    case 5:
      return change_unit(session, random);
    case 6:
      return remove_views(session, random);
    case 7:
      return swap_poses(session, random);
    case 8:
      return duplicate_views(session, random);
    default:
      return mix_travel(session, random);
  }
}

TEST(Corruptions, GiveNoRigThatIsWorseThanItSays) {
  constexpr double kMaxSigmas = 5;
  int usable = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    auto truth = rail_rig(seed % 4 == 0 ? 1 : 2, seed);
    for (auto& sensor : truth.sensors) sensor.camera.distortion[4] = 0;
    const testing::SessionOptions options{.poses = 14, .seed = seed};
    Corrupted session{observe(truth, options), ""};
    for (auto& sensor : session.observations.sensors)
      for (auto& view : sensor.views) view.laser_apart = true;
    const auto good = session.observations;
    Random random(seed, 77);
    corrupt(session, static_cast<int>(seed) % kFaults, random, truth, options);
    CalibrationOptions calibration;
    calibration.lens = LensModel::kBrown4;
    const auto result = calibrate_rig(session.observations, calibration);
    if (std::getenv("LIGHTSTRIPE_PRINT"))
      fmt::print("{:2} {}: {}\n", seed, session.what, result.summary.message);
    EXPECT_TRUE(result.summary.usable || result.summary.message.size() > 40) << result.summary.message;
    if (!result.summary.usable) continue;
    ++usable;
    const auto state = testing::state_of(result.rig);
    const auto error = testing::section_error(state, truth, good);
    const auto& quality = result.rig.quality;
    if (std::getenv("LIGHTSTRIPE_PRINT"))
      fmt::print("   shape {:.4f} of {:.4f}, place {:.3f} of {:.3f}\n", error.shape_mm,
                 quality.section_shape_sigma_mm, error.absolute_mm, quality.section_absolute_sigma_mm);
    EXPECT_LT(error.shape_mm, kMaxSigmas * quality.section_shape_sigma_mm)
        << "seed " << seed << ": " << session.what;
    if (!session.observations.motion) continue;  // x is another direction then
    EXPECT_LT(error.absolute_mm, kMaxSigmas * quality.section_absolute_sigma_mm)
        << "seed " << seed << ": " << session.what;
  }
  EXPECT_GT(usable, 5) << "a wrong minority is left out";
}

}  // namespace
}  // namespace lightstripe
