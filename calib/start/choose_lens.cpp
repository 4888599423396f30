// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/start/choose_lens.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "calib/adjust/reduced_covariance.h"
#include "calib/adjust/solve_problem.h"
#include "parallel/parallel.h"

namespace lightstripe {
namespace {

constexpr std::size_t kMinViews = 8;
constexpr std::array<LensModel, 7> kCandidates{
    LensModel::kBrown4,   LensModel::kTilted,         LensModel::kBrown5,   LensModel::kTilted5,
    LensModel::kRational, LensModel::kTiltedRational, LensModel::kThinPrism};

/// The views of one camera alone, as a problem of their own.
struct CameraViews {
  SessionViews session;
  RigState state;
  std::vector<Residual> list;
};

CameraViews camera_views(const InitialValues& values, int sensor, std::size_t fold) {
  const auto& all = values.session;
  const auto s = static_cast<std::size_t>(sensor);
  CameraViews result;
  result.session.target = all.target;
  result.session.sensor_names = {all.sensor_names[s]};
  result.session.image_sizes = {all.image_sizes[s]};
  result.session.given_cameras.resize(1);
  result.state.sensors.push_back({values.state.sensors[s].camera, {}, {}});
  std::size_t seen = 0;
  for (std::size_t i = 0; i < all.views.size(); ++i) {
    const bool shows_board =
        all.views[i].sensor == sensor && all.views[i].pose >= 0 && !all.views[i].height_mm;
    if (!shows_board || seen++ % 2 != fold) continue;
    SessionView view;
    view.pose = static_cast<int>(result.state.first_from_board.size());
    view.corners = all.views[i].corners;
    for (std::size_t c = 0; c < view.corners.size(); ++c)
      if (is_seen(view.corners[c])) result.list.push_back({result.session.views.size(), -1, c, 0.1});
    result.session.views.push_back(std::move(view));
    result.state.first_from_board.push_back(values.cam_from_board[i]);
  }
  return result;
}

/// Mean squared error of each view's corners, px^2, without the largest twentieth of them: outliers.
std::vector<double> view_errors(const CameraViews& views) {
  std::vector<std::vector<double>> squares(views.session.views.size());
  const auto& camera = views.state.sensors[0].camera;
  for (const auto& m : views.list) {
    const auto xy = views.session.target.corner(static_cast<int>(m.index));
    const auto place = board_place(views.session.target, xy);
    const auto q =
        project(camera, views.state.first_from_board[m.view] * place.point(views.state.board_warp_mm));
    const auto& seen = views.session.views[m.view].corners[m.index];
    squares[m.view].push_back(q ? (*q - seen).squaredNorm() : std::numeric_limits<double>::infinity());
  }
  std::vector<double> errors;
  for (auto& of_view : squares) {
    std::sort(of_view.begin(), of_view.end());
    of_view.resize(of_view.size() - of_view.size() / 20);
    double sum = 0;
    for (const double square : of_view) sum += square;
    errors.push_back(sum / static_cast<double>(std::max<std::size_t>(1, of_view.size())));
  }
  return errors;
}

/// Solves for what the options leave free; false where that fails, or the views leave a term open.
bool solve(CameraViews& views, LensModel lens, bool board_warp) {
  constexpr double kMaxCondition = 1e10;  // brown4 and tilted models have 1e6 to 1e8
  constexpr double kRobustScale = 30;     // of 0.1 px: gross errors only
  JointProblem joint(views.session, views.state, views.list,
                     {{lens}, board_warp, ProblemOptions::Loss::kHuber, kRobustScale});
  const auto summary = solve_problem(joint, 30, 1e-7);
  views.state = joint.state();
  return summary.IsSolutionUsable() &&
         (joint.num_globals() == 0 || reduced_covariance(joint).condition < kMaxCondition);
}

/// Errors of the views of `fold` under a model fitted to the others; empty where there is none, or it folds.
std::vector<double> held_out_errors(const InitialValues& values, int sensor, std::size_t fold, LensModel lens,
                                    bool board_warp) {
  CameraViews train = camera_views(values, sensor, 1 - fold), test = camera_views(values, sensor, fold);
  if (has_tilt(lens))
    train.state.sensors[0].camera.distortion[2] = train.state.sensors[0].camera.distortion[3] = 0;
  if (!solve(train, lens, board_warp) || !invertible_over_image(train.state.sensors[0].camera)) return {};
  test.state.sensors = train.state.sensors;
  test.state.board_warp_mm = train.state.board_warp_mm;
  test.session.given_cameras[0] = GivenCamera{test.state.sensors[0].camera, true};
  if (!solve(test, lens, false)) return {};
  return view_errors(test);
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Whether `a` is larger than `b` by more than that many standard errors of their paired difference, and by
/// more than nothing: perfect data differ in the last bits.
bool clearly_larger(const std::vector<double>& a, const std::vector<double>& b, double standard_errors) {
  constexpr double kNothing_px2 = 1e-8;
  const double n = static_cast<double>(a.size()), difference = mean(a) - mean(b);
  double variance = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    variance += (a[i] - b[i] - difference) * (a[i] - b[i] - difference) / (n - 1);
  return difference > std::max(kNothing_px2, standard_errors * std::sqrt(variance / n));
}

using Tried = std::pair<LensModel, std::vector<double>>;  // a model and its errors by view

/// Whether a richer model is worth its uncertainty: among many models one is better by chance, but hardly by
/// this much.
bool worth_it(const std::vector<double>& lean, const std::vector<double>& rich) {
  constexpr double kLeastGain = 0.002, kStandardErrors = 3;
  return mean(lean) > (1 + kLeastGain) * mean(rich) && clearly_larger(lean, rich, kStandardErrors);
}

/// A tilted sensor without need only makes the camera's frame uncertain.
bool tilt_worth_it(const std::vector<double>& upright, const std::vector<double>& tilted) {
  return mean(upright) > 1.01 * mean(tilted) && clearly_larger(upright, tilted, 3);
}

/// From the leanest on, a richer model takes over where it is worth it; a tilted one where the tilt is.
LensModel leanest_worth_it(const std::vector<Tried>& tried) {
  const Tried* chosen = &tried.front();
  for (const Tried& next : tried) {
    const bool tilts = has_tilt(next.first) && !has_tilt(chosen->first);
    const bool better =
        tilts ? tilt_worth_it(chosen->second, next.second) : worth_it(chosen->second, next.second);
    if (better) chosen = &next;
  }
  return chosen->first;
}

}  // namespace

LensChoice choose_lens(const InitialValues& values, int sensor, const CalibrationOptions& options) {
  LensChoice choice;
  choice.sensor = values.session.sensor_names[static_cast<std::size_t>(sensor)];
  choice.lens = LensModel::kBrown4;
  const auto views =
      std::count_if(values.session.views.begin(), values.session.views.end(),
                    [&](const auto& v) { return v.sensor == sensor && v.pose >= 0 && !v.height_mm; });
  if (static_cast<std::size_t>(views) < kMinViews) return choice;
  std::array<std::array<std::vector<double>, 2>, kCandidates.size()> halves;
  const auto try_lens = [&](std::size_t i) {
    halves[i / 2][i % 2] = held_out_errors(values, sensor, i % 2, kCandidates[i / 2], options.board_warp);
  };
  parallel_for(2 * kCandidates.size(), try_lens);
  std::vector<Tried> tried;
  for (std::size_t i = 0; i < kCandidates.size(); ++i) {
    auto errors = halves[i][0];
    errors.insert(errors.end(), halves[i][1].begin(), halves[i][1].end());
    if (halves[i][0].empty() || halves[i][1].empty() || !std::isfinite(mean(errors))) continue;
    choice.trials.push_back({kCandidates[i], std::sqrt(mean(errors))});
    tried.emplace_back(kCandidates[i], std::move(errors));
  }
  if (tried.empty()) return choice;
  choice.lens = leanest_worth_it(tried);
  return choice;
}

}  // namespace lightstripe
