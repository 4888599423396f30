// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The bends of rigs that need more than one rigid section: both rails of a track, and a turning wheel.
// Repeats of a calibration against what the bends say of each.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "calib/adjust/joint_adjustment.h"
#include "calib/adjust/session_views.h"
#include "calib/calibrate_rig.h"
#include "calib/start/initial_values.h"
#include "section_error.h"

namespace lightstripe {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using testing::rail_rig;
using testing::SessionOptions;
using testing::state_of;
using testing::SyntheticRig;

const Vector3d kUp(0, -1, 0);

/// Squares of a measured quantity's errors and of what the bends predict, summed over repeats.
struct Tally {
  double actual = 0, predicted = 0;
  double ratio() const { return actual / predicted; }
};

/// One calibration beside the truth: the section's samples, what they err by, and the bends.
struct Trial {
  std::vector<SectionSample> samples;
  VectorXd section, error;
  SectionBends bends;

  /// Only what the bends are made of: all that calibrate_rig() finds out besides takes as long again.
  template <class Scene>
  Trial(const Scene& scene, const CalibrationObservations& observations)
      : samples(testing::samples_of(scene.rig, observations)) {
    const InitialValues start = initial_values(prepare_session_views(observations));
    const JointAdjustment found = adjust_jointly(start.session, start.state, lenses(scene.rig), options());
    section = scene.section(found.state, samples);
    error = section - scene.section(scene.state(), samples);
    bends = section_bends(start.session, found, section_errors(start.session, found, kUp), kUp);
  }
  static CalibrationOptions options() {
    CalibrationOptions out;
    out.lens = LensModel::kBrown4;
    return out;
  }
  static std::vector<LensModel> lenses(const SyntheticRig& rig) {
    return std::vector<LensModel>(rig.sensors.size(), LensModel::kBrown4);
  }

  /// `form`: of the displacements, one after the other.
  void count(const VectorXd& form, Tally& tally) const {
    tally.actual += std::pow(form.dot(error), 2);
    for (std::size_t b = 0; b < bends.bends.size(); ++b) {
      double sum = 0;
      for (std::size_t i = 0; i < samples.size(); ++i) {
        const auto row = 2 * static_cast<Eigen::Index>(i);
        sum += form.segment<2>(row).dot(
            displacement(bends, b, samples[i].sensor, section(row), section(row + 1)));
      }
      tally.predicted += sum * sum;
    }
  }
  /// Mean displacement along `direction` of the samples that `want(sensor, y, z)`.
  template <class Want>
  VectorXd mean(const Eigen::Vector2d& direction, const Want& want) const {
    VectorXd form = VectorXd::Zero(section.size());
    double number = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const auto row = 2 * static_cast<Eigen::Index>(i);
      if (!want(samples[i].sensor, section(row), section(row + 1))) continue;
      form.segment<2>(row) = direction, ++number;
    }
    return form / number;
  }
  /// The form of a section that is first laid on these sensors' samples.
  VectorXd laid_on(const VectorXd& form, int first, int last) const {
    std::vector<Eigen::Index> rows;
    for (std::size_t i = 0; i < samples.size(); ++i)
      if (samples[i].sensor >= first && samples[i].sensor <= last)
        for (const Eigen::Index axis : {0, 1}) rows.push_back(2 * static_cast<Eigen::Index>(i) + axis);
    VectorXd out = form;
    out(rows) = without_rigid_motion(section(rows), form(rows));
    return out;
  }
  /// The value of a coordinate (0: y or u, 1: z or v) above which `share` of the sensors' samples lie.
  double upper(int axis, double share, int first, int last) const {
    std::vector<double> values;
    for (std::size_t i = 0; i < samples.size(); ++i)
      if (samples[i].sensor >= first && samples[i].sensor <= last)
        values.push_back(section(2 * static_cast<Eigen::Index>(i) + axis));
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>((1 - share) * static_cast<double>(values.size() - 1))];
  }
};

// 30 repeats know a variance to 26 %; bends scaled by 0.7 or 1.4 change it by a factor of 2.
constexpr int kRepeats = 30;
constexpr double kLow = 0.6, kHigh = 1.6;

/// Hands the trial of every repeat to `count`.
template <class Scene, class Count>
void repeat(const Scene& scene, std::uint64_t first_seed, const Count& count) {
  for (int i = 0; i < kRepeats; ++i) {
    const auto observations = scene.observe(first_seed + static_cast<std::uint64_t>(i));
    const Trial trial(scene, observations);
    if (i == 0) {
      const auto result = calibrate_rig(observations, Trial::options());
      ASSERT_TRUE(result.summary.usable) << result.summary.message;
      EXPECT_EQ(result.rig.quality.section_bends->bends, trial.bends.bends);
    }
    count(trial);
    ::testing::Test::RecordProperty("bends", static_cast<int>(trial.bends.bends.size()));
  }
}

void expect_right(const Tally& tally, const std::string& what) {
  ::testing::Test::RecordProperty(what, std::to_string(tally.ratio()));
  EXPECT_GT(tally.ratio(), kLow) << what;
  EXPECT_LT(tally.ratio(), kHigh) << what;
}

/// With what lies in the image.
BoardView view_of(const SyntheticRig& rig, std::size_t s, const Rigid3& first_from_board,
                  const SessionOptions& options) {
  constexpr double kWidest = 0.5;  // x / z beyond which the lens model folds back into the image
  const SensorState& sensor = rig.sensors[s];
  const Rigid3 cam_from_board = sensor.cam_from_first * first_from_board;
  BoardView view;
  view.corners = testing::seen_corners(rig.target, sensor.camera, cam_from_board);
  for (int i = 0; i < rig.target.num_corners(); ++i) {
    const Eigen::Vector2d corner = rig.target.corner(i);
    const Vector3d p = cam_from_board * Vector3d(corner.x(), corner.y(), 0);
    Eigen::Vector2d& q = view.corners[static_cast<std::size_t>(i)];
    if (p.z() < 100 || p.head<2>().norm() > kWidest * p.z() || !testing::inside(sensor.camera, q))
      q = unseen_corner();
  }
  auto& stripe = view.stripes.emplace_back(
      testing::seen_stripe(rig.target, sensor, cam_from_board, options.stripe_width_px));
  std::erase_if(stripe, [&](const StripePoint& point) {  // folded back as well
    const auto ray = unproject(sensor.camera, {point.x, point.y});
    const auto p = ray ? intersect(sensor.laser_planes[0], Vector3d::Zero(), *ray) : std::nullopt;
    return !p || std::abs((cam_from_board.inverse() * *p).z()) > 1e-3;
  });
  return view;
}

// ---- a track

/// A board so long that the sensors over both rails see an end of it; a pair of sensors over each rail.
struct Track {
  SyntheticRig rig = rail_rig(2, 4);
  Eigen::Quaterniond facing;  ///< of a board that faces the first pair
  Vector3d across;            ///< from the first pair to the second
  static constexpr double kApartMm = 1436;

  Track() {
    rig.target.type = TargetType::kCharuco;  // a part of it is enough
    rig.target.marker_mm = 7;
    rig.target.columns = 170;
    const Vector3d normal = rig.sensors[1].laser_planes.front().normal;
    facing = Eigen::AngleAxisd(-0.5 * 55 * kDegree, normal);
    const Vector3d x = facing * Vector3d::UnitX();
    across = (x - rig.direction * rig.direction.dot(x)).normalized();
    for (SensorState sensor : rail_rig(2, 9).sensors) {
      sensor.cam_from_first.translation -= sensor.cam_from_first.rotation * (kApartMm * across);
      rig.sensors.push_back(sensor);
    }
  }

  RigState state() const { return state_of(rig); }
  VectorXd section(const RigState& state, const std::vector<SectionSample>& samples) const {
    return section_of(state, MotionType::kLinear, kUp, samples);
  }
  /// Each pair's own poses, poses that both pairs see, and the travel.
  CalibrationObservations observe(std::uint64_t seed) const;
  /// Its middle `at` mm along `across`, tilted by up to these degrees about its length and against it.
  Rigid3 board(double at, double tilt_deg, double slant_deg, Random& random) const {
    const double t = tilt_deg * kDegree, s = slant_deg * kDegree;
    const Eigen::Quaterniond q = facing * Eigen::AngleAxisd(random.uniform(-t, t), Vector3d::UnitX()) *
                                 Eigen::AngleAxisd(random.uniform(-s, s), Vector3d::UnitY()) *
                                 Eigen::AngleAxisd(random.uniform(-s, s), Vector3d::UnitZ());
    const Vector3d centre = at * across + Vector3d(random.uniform(-20, 20), random.uniform(-25, 25),
                                                   rig.range_mm + random.uniform(-40, 40));
    return {q, centre - q * Vector3d(rig.target.middle().x(), rig.target.middle().y(), 0)};
  }
};

CalibrationObservations Track::observe(std::uint64_t seed) const {
  constexpr int kOwn = 12, kCommon = 8;
  const SessionOptions options;
  Random random(seed, 21);
  CalibrationObservations out;
  out.target = rig.target;
  for (std::size_t s = 0; s < rig.sensors.size(); ++s)
    out.sensors.push_back({"s" + std::to_string(s), 960, 700, 1, {}, {}});
  const auto show = [&](const Rigid3& shown, std::size_t first, std::size_t last, const std::string& pose) {
    for (std::size_t s = first; s <= last; ++s) {
      BoardView view = view_of(rig, s, shown, options);
      view.pose = pose, view.image = out.sensors[s].name + "_" + pose;
      testing::add_noise(view, options, random);
      out.sensors[s].views.push_back(view);
    }
  };
  for (int i = 0; i < kOwn; ++i) {
    show(board(0, 32, 32, random), 0, 1, "left_" + std::to_string(i));
    show(board(kApartMm, 32, 32, random), 2, 3, "right_" + std::to_string(i));
  }
  for (int i = 0; i < kCommon; ++i)
    show(board(kApartMm / 2, 30, 2, random), 0, 3, "both_" + std::to_string(i));
  MotionObservations& motion = out.motion.emplace();
  const Rigid3 still = board(0, 10, 10, random);
  for (int i = 0; i < options.travel_steps; ++i) {
    const double travel = options.travel_mm * (i / (options.travel_steps - 1.0) - 0.5);
    Rigid3 moved = still;
    moved.translation -= travel * rig.direction;
    BoardView view = view_of(rig, 0, moved, options);
    view.stripes.clear();
    view.image = "travel_" + std::to_string(i);
    testing::add_noise(view, options, random);
    motion.views.push_back(view), motion.travel.push_back(travel);
  }
  return out;
}

TEST(SectionBendsOfATrack, TellTheGaugeAndEachRailsOwnShape) {
  Tally gauge, left_top, right_top;
  repeat(Track(), 300, [&](const Trial& trial) {
    const auto left = [](int sensor, double, double) { return sensor < 2; };
    const auto right = [](int sensor, double, double) { return sensor >= 2; };
    Eigen::Vector2d apart(
        trial.mean({1, 0}, right).dot(trial.section) - trial.mean({1, 0}, left).dot(trial.section),
        trial.mean({0, 1}, right).dot(trial.section) - trial.mean({0, 1}, left).dot(trial.section));
    apart.normalize();
    trial.count(trial.mean(apart, right) - trial.mean(apart, left), gauge);
    for (const int first : {0, 2}) {
      const double high = trial.upper(1, 0.1, first, first + 1);
      const auto top = [&](int sensor, double, double z) { return sensor / 2 == first / 2 && z > high; };
      trial.count(trial.laid_on(trial.mean({0, 1}, top), first, first + 1),
                  first == 0 ? left_top : right_top);
    }
  });
  expect_right(gauge, "gauge");
  expect_right(left_top, "left_top");
  expect_right(right_top, "right_top");
}

// ---- a turning wheel

/// The rig's axis lies across the section, as a wheel's.
struct Stand {
  SyntheticRig rig = rail_rig(2, 4);
  Vector3d axis, point;

  Stand() {
    axis = rig.direction.cross(Vector3d::UnitZ()).normalized();
    point = Vector3d(0, 0, rig.range_mm) + 460 * axis.cross(rig.direction).normalized();
  }
  RigState state() const {
    RigState out = state_of(rig);
    out.motion->direction = axis, out.motion->axis_point = point;
    return out;
  }
  VectorXd section(const RigState& state, const std::vector<SectionSample>& samples) const {
    return axial_section_of(state, kUp, samples);
  }
  CalibrationObservations observe(std::uint64_t seed) const;
};

CalibrationObservations Stand::observe(std::uint64_t seed) const {
  const SessionOptions options{.seed = seed};
  CalibrationObservations out = testing::observe(rig, options);
  MotionObservations& motion = *out.motion;
  motion.type = MotionType::kRotary, motion.moves = Moves::kObject;
  motion.views.clear(), motion.travel.clear();
  Random random(seed, 22);
  const Rigid3 board = testing::visible_board(rig, {.max_tilt_deg = 5}, random);
  for (const double angle : {-4.0, -2.0, 0.0, 2.0, 4.0}) {
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle * kDegree, axis));
    const Rigid3 turned = Rigid3{turn, point - turn * point} * board;
    BoardView view = view_of(rig, 0, turned, options);
    view.stripes.clear();
    view.image = "turned_" + std::to_string(angle);
    testing::add_noise(view, options, random);
    motion.views.push_back(view), motion.travel.push_back(angle);
  }
  return out;
}

// The radius, and what a turn of the section does to a flange's height over the tread: neither is free where
// radii are measured.
TEST(SectionBendsOfATurningRig, TellTheRadiusAndHeightsAlongTheAxis) {
  Tally radius, flange, shape;
  repeat(Stand(), 500, [&](const Trial& trial) {
    const auto all = [](int, double, double) { return true; };
    const double far = trial.upper(0, 0.1, 0, 1), near = trial.upper(0, 0.9, 0, 1);
    const VectorXd height = trial.mean({0, 1}, [&](int, double u, double) { return u > far; }) -
                            trial.mean({0, 1}, [&](int, double u, double) { return u < near; });
    trial.count(trial.mean({0, 1}, all), radius);
    trial.count(height, flange);
    const double high = trial.upper(1, 0.1, 0, 1);
    const auto top = [&](int, double, double v) { return v > high; };
    trial.count(trial.laid_on(trial.mean({0, 1}, top), 0, 1), shape);
  });
  expect_right(radius, "radius");
  expect_right(flange, "flange");
  expect_right(shape, "shape");
}

}  // namespace
}  // namespace lightstripe
