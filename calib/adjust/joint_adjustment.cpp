// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/adjust/joint_adjustment.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "calib/adjust/adjustment_rounds.h"
#include "core/robust.h"

namespace lightstripe {
namespace {

constexpr double kMinSigmaPx = 0.005;     // perfect data must not divide by zero
constexpr std::size_t kMinForSigma = 40;  // residuals of a group from which its sigma is estimated

enum class Spread { kMedian, kRms };

/// Groups of equal error: a sensor's corners, its stripe points, and its corners of the travelling views,
/// which carry the travel's own error.
constexpr std::size_t kGroups = 3;
std::size_t group_of(const SessionViews& session, const Residual& residual) {
  const auto& view = session.views[residual.view];
  const std::size_t kind = !residual.is_corner() ? 1 : view.pose < 0 ? 2 : 0;
  return kGroups * static_cast<std::size_t>(view.sensor) + kind;
}

double stripe_sigma_px(const StripePoint& point, const CalibrationOptions& options) {
  return std::hypot(point.sigma_px, options.stripe_sigma_floor_px);
}

double mean_variance(const std::vector<StripePoint>& points, const CalibrationOptions& options) {
  double sum = 0;
  for (const auto& point : points) sum += std::pow(stripe_sigma_px(point, options), 2);
  return sum / static_cast<double>(points.size());
}

/// The mean variance of each sensor's stripe points. One laser draws them all on one board.
std::vector<double> common_variances(const SessionViews& session, const CalibrationOptions& options) {
  std::vector<double> sums(session.sensor_names.size(), 0), counts = sums;
  for (const auto& view : session.views)
    for (const auto& stripe : view.stripes) {
      if (stripe.empty()) continue;
      const auto n = static_cast<double>(stripe.size());
      sums[static_cast<std::size_t>(view.sensor)] += n * mean_variance(stripe, options);
      counts[static_cast<std::size_t>(view.sensor)] += n;
    }
  for (std::size_t s = 0; s < sums.size(); ++s) sums[s] /= std::max(1.0, counts[s]);
  return sums;
}

/// By what the points' sigmas are multiplied: a stripe of few points tells its own scatter badly (the grain
/// of the light), and one that seems exact by chance must not decide. Its variance is drawn to the sensor's,
/// as if that had been seen in kCommonPoints points as well (empirical Bayes, Smyth 2004).
double moderation(const std::vector<StripePoint>& stripe, double common, const CalibrationOptions& options) {
  constexpr double kCommonPoints = 15;
  if (stripe.empty()) return 1;
  const auto n = static_cast<double>(stripe.size());
  const double own = mean_variance(stripe, options);
  return std::sqrt((n * own + kCommonPoints * common) / ((n + kCommonPoints) * own));
}

std::vector<Residual> list_residuals(const SessionViews& session, const CalibrationOptions& options) {
  std::vector<Residual> list;
  const std::vector<double> common = common_variances(session, options);
  for (std::size_t v = 0; v < session.views.size(); ++v) {
    const auto& view = session.views[v];
    for (std::size_t i = 0; i < view.corners.size(); ++i)
      if (is_seen(view.corners[i])) list.push_back({v, -1, i, options.corner_sigma_px});
    for (std::size_t p = 0; p < view.stripes.size(); ++p) {
      const double factor =
          moderation(view.stripes[p], common[static_cast<std::size_t>(view.sensor)], options);
      for (std::size_t i = 0; i < view.stripes[p].size(); ++i)
        list.push_back({v, static_cast<int>(p), i, factor * stripe_sigma_px(view.stripes[p][i], options)});
    }
  }
  return list;
}

double spread_of(std::vector<double> normalised, Spread spread) {
  if (spread == Spread::kRms) {
    double sum = 0;
    for (const double r : normalised) sum += r * r;
    return std::sqrt(sum / static_cast<double>(normalised.size()));
  }
  return kMadToSigma * upper_median(normalised);
}

/// Scales the sigmas of each group so that its normalised residuals have unit spread (variance components);
/// `redundancy` = 1 - unknowns / residuals.
void estimate_sigmas(const SessionViews& session, Spread spread, double redundancy,
                     std::vector<Residual>& list) {
  std::vector<std::vector<double>> groups(kGroups * session.sensor_names.size());
  for (const auto& residual : list) {
    if (!residual.used) continue;
    auto& group = groups[group_of(session, residual)];
    for (int i = 0; i < residual.dimension(); ++i)
      group.push_back(std::abs(residual.residual_px[i]) / residual.sigma_px);
  }
  std::vector<double> scales;
  scales.reserve(groups.size());
  for (auto& group : groups)
    scales.push_back(
        group.size() < kMinForSigma ? 1.0 : spread_of(std::move(group), spread) / std::sqrt(redundancy));
  for (auto& residual : list)
    residual.sigma_px = std::max(kMinSigmaPx, residual.sigma_px * scales[group_of(session, residual)]);
}

void remove_outliers(double limit, std::vector<Residual>& list) {
  for (auto& residual : list) residual.used = residual.used && residual.normalised() <= limit;
}

/// Terms that the lens model does not have are 0, those of a fixed camera stay.
RigState with_terms_of(const std::vector<LensModel>& lenses, const SessionViews& session, RigState state) {
  for (std::size_t s = 0; s < state.sensors.size(); ++s) {
    if (session.given_cameras[s] && session.given_cameras[s]->fixed) continue;
    auto& terms = state.sensors[s].camera.distortion;
    std::array<double, kDistortionTerms> kept{};
    for (const int i : free_terms(lenses[s]))
      kept[static_cast<std::size_t>(i)] = terms[static_cast<std::size_t>(i)];
    terms = kept;
  }
  return state;
}

}  // namespace

JointAdjustment adjust_jointly(const SessionViews& session, const RigState& start,
                               const std::vector<LensModel>& lenses, const CalibrationOptions& options) {
  using Loss = ProblemOptions::Loss;
  AdjustmentRounds rounds{session, options, {}};
  auto& residuals = rounds.result.residuals;
  rounds.result.state = with_terms_of(lenses, session, start);
  rounds.result.lenses = lenses;
  residuals = list_residuals(session, options);

  // Huber finds its way from a rough start with the sigmas that were given.
  if (!rounds.solve(Loss::kHuber, kRoughTolerance)) return rounds.result;
  estimate_sigmas(session, Spread::kMedian, rounds.redundancy, residuals);
  // Cauchy lets go of a stripe or a view that is wrong as a whole.
  if (!rounds.solve(Loss::kCauchy, kRoughTolerance)) return rounds.result;
  estimate_sigmas(session, Spread::kMedian, rounds.redundancy, residuals);
  remove_outliers(options.outlier_sigma, residuals);
  // Least squares without the outliers gives the final sigmas.
  if (!rounds.solve(Loss::kSquared, kRoughTolerance)) return rounds.result;
  estimate_sigmas(session, Spread::kRms, rounds.redundancy, residuals);
  rounds.solve(Loss::kSquared, kFinalTolerance, true);
  return rounds.result;
}

}  // namespace lightstripe
