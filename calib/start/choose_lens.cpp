// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/start/choose_lens.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "calib/adjust/reduced_covariance.h"
#include "calib/adjust/solve_problem.h"
#include "core/robust.h"
#include "parallel/parallel.h"

namespace lightstripe {
namespace {

constexpr std::size_t kMinViewsOfLens = 8;
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

/// Squared errors of each view's corners, px^2; infinity where the camera cannot see them.
using ViewSquares = std::vector<std::vector<double>>;

ViewSquares corner_squares(const CameraViews& views) {
  ViewSquares squares(views.session.views.size());
  const auto& camera = views.state.sensors[0].camera;
  for (const auto& m : views.list) {
    const auto xy = views.session.target.corner(static_cast<int>(m.index));
    const auto place = board_place(views.session.target, xy);
    const auto q =
        project(camera, views.state.first_from_board[m.view] * place.point(views.state.board_warp_mm));
    const auto& seen = views.session.views[m.view].corners[m.index];
    squares[m.view].push_back(q ? (*q - seen).squaredNorm() : std::numeric_limits<double>::infinity());
  }
  return squares;
}

/// How large a corner's squared error may be, given its view's: beyond it the corner itself is wrong, under
/// the laser's line or behind a hand.
double outlier_limit(const std::vector<double>& squares) {
  constexpr double kSigmas = 5;
  constexpr double kMedianOfSquares = 1.386;  // of two coordinates, over sigma^2
  return kSigmas * kSigmas * median(squares) / kMedianOfSquares;
}

std::vector<Residual> without_outliers(const CameraViews& views) {
  const ViewSquares squares = corner_squares(views);
  std::vector<double> limits;
  for (const auto& of_view : squares) limits.push_back(of_view.empty() ? 0 : outlier_limit(of_view));
  std::vector<std::size_t> next(squares.size());
  std::vector<Residual> kept;
  for (const Residual& m : views.list)
    if (squares[m.view][next[m.view]++] <= limits[m.view]) kept.push_back(m);
  return kept;
}

/// Solves for what the options leave free, twice: the second time without corners that are wrong. False where
/// that fails, or the views leave a term open.
bool solve(CameraViews& views, LensModel lens, bool board_warp) {
  constexpr double kMaxCondition = 1e10;  // brown4 and tilted models have 1e6 to 1e8
  constexpr double kRobustScale = 30;     // of 0.1 px: gross errors only
  const auto solved = [&](const std::vector<Residual>& list) {
    JointProblem joint(views.session, views.state, list,
                       {{lens}, board_warp, ProblemOptions::Loss::kHuber, kRobustScale});
    const auto summary = solve_problem(joint, 30, 1e-7);
    views.state = joint.state();
    return summary.IsSolutionUsable() &&
           (joint.num_globals() == 0 || reduced_covariance(joint).condition < kMaxCondition);
  };
  if (!solved(views.list)) return false;
  const auto kept = without_outliers(views);
  return kept.size() == views.list.size() || solved(kept);
}

/// Errors of the views of `fold` under a model fitted to the others; empty where there is none, or it folds.
ViewSquares held_out_squares(const InitialValues& values, int sensor, std::size_t fold, LensModel lens,
                             bool board_warp) {
  CameraViews train = camera_views(values, sensor, 1 - fold), test = camera_views(values, sensor, fold);
  if (has_tilt(lens))
    train.state.sensors[0].camera.distortion[2] = train.state.sensors[0].camera.distortion[3] = 0;
  if (!solve(train, lens, board_warp) || !invertible_over_image(train.state.sensors[0].camera)) return {};
  test.state.sensors = train.state.sensors;
  test.state.board_warp_mm = train.state.board_warp_mm;
  test.session.given_cameras[0] = GivenCamera{test.state.sensors[0].camera, true};
  if (!solve(test, lens, false)) return {};
  return corner_squares(test);
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

/// A model and what it leaves of the views' corners.
struct Held {
  LensModel lens;
  ViewSquares squares;
};

/// Of each corner the least that any model leaves.
ViewSquares least_squares_of(const std::vector<Held>& models) {
  ViewSquares least = models.front().squares;
  for (const Held& model : models)
    for (std::size_t v = 0; v < least.size(); ++v)
      for (std::size_t c = 0; c < least[v].size(); ++c)
        least[v][c] = std::min(least[v][c], model.squares[v][c]);
  return least;
}

/// Mean squared error of each view's corners, px^2, without those that no model explains, which would drown
/// what the models differ in.
std::vector<double> view_errors(const ViewSquares& squares, const ViewSquares& least) {
  std::vector<double> errors;
  for (std::size_t v = 0; v < squares.size(); ++v) {
    if (squares[v].empty()) continue;
    const double limit = outlier_limit(least[v]);
    double sum = 0, count = 0;
    for (std::size_t c = 0; c < squares[v].size(); ++c) {
      if (least[v][c] > limit) continue;
      sum += squares[v][c];
      ++count;
    }
    errors.push_back(sum / count);
  }
  return errors;
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

/// Of the models that both halves of the views can be fitted by.
std::vector<Tried> held_out_errors(const InitialValues& values, int sensor, bool board_warp) {
  std::array<std::array<ViewSquares, 2>, kCandidates.size()> halves;
  const auto try_lens = [&](std::size_t i) {
    halves[i / 2][i % 2] = held_out_squares(values, sensor, i % 2, kCandidates[i / 2], board_warp);
  };
  parallel_for(2 * kCandidates.size(), try_lens);
  std::vector<Held> models;
  for (std::size_t i = 0; i < kCandidates.size(); ++i) {
    auto& [squares, rest] = halves[i];
    if (squares.empty() || rest.empty()) continue;
    squares.insert(squares.end(), rest.begin(), rest.end());
    models.push_back({kCandidates[i], std::move(squares)});
  }
  std::vector<Tried> tried;
  if (models.empty()) return tried;
  const ViewSquares least = least_squares_of(models);
  for (const Held& model : models) tried.emplace_back(model.lens, view_errors(model.squares, least));
  return tried;
}

}  // namespace

LensChoice choose_lens(const InitialValues& values, int sensor, const CalibrationOptions& options) {
  LensChoice choice;
  choice.sensor = values.session.sensor_names[static_cast<std::size_t>(sensor)];
  choice.lens = LensModel::kBrown4;
  const auto views =
      std::count_if(values.session.views.begin(), values.session.views.end(),
                    [&](const auto& v) { return v.sensor == sensor && v.pose >= 0 && !v.height_mm; });
  if (static_cast<std::size_t>(views) < kMinViewsOfLens) return choice;
  std::vector<Tried> tried;
  for (const auto& [lens, errors] : held_out_errors(values, sensor, options.board_warp)) {
    if (!std::isfinite(mean(errors))) continue;
    choice.trials.push_back({lens, std::sqrt(mean(errors))});
    tried.emplace_back(lens, errors);
  }
  if (tried.empty()) return choice;
  choice.lens = leanest_worth_it(tried);
  return choice;
}

}  // namespace lightstripe
