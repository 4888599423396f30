// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/klingel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lightstripe {
namespace {

constexpr double kFineMm = 0.01;

/// Index of the fine node where the potential has its bottom: delta_r turns from - to + nearest to 0; nothing
/// where it never does.
std::optional<std::size_t> bottom_of(const std::vector<double>& shift, const std::vector<double>& force) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i + 1 < shift.size(); ++i)
    if (force[i] <= 0 && force[i + 1] >= 0 && (!best || std::abs(shift[i]) < std::abs(shift[*best])))
      best = i;
  return best;
}

}  // namespace

double RadiusDifference::at(double shift) const {
  const double place =
      std::clamp((shift - first_mm) / step_mm, 0.0, static_cast<double>(delta_r_mm.size() - 1));
  const auto i = std::min(static_cast<std::size_t>(place), delta_r_mm.size() - 2);
  const double t = place - static_cast<double>(i);
  return (1 - t) * delta_r_mm[i] + t * delta_r_mm[i + 1];
}

KlingelWave::KlingelWave(const RadiusDifference& difference) {
  if (difference.delta_r_mm.size() < 2) return;
  const auto count =
      static_cast<std::size_t>(std::lround((difference.last_mm() - difference.first_mm) / kFineMm));
  std::vector<double> force;
  for (std::size_t i = 0; i <= count; ++i) {
    shift_.push_back(difference.first_mm + kFineMm * static_cast<double>(i));
    force.push_back(difference.at(shift_.back()) / 2);
  }
  const auto bottom = bottom_of(shift_, force);
  if (!bottom) return;
  middle_index_ = *bottom;
  middle_ = shift_[middle_index_];
  potential_.assign(shift_.size(), 0.0);
  for (std::size_t i = 1; i < shift_.size(); ++i)
    potential_[i] = potential_[i - 1] + kFineMm * (force[i] + force[i - 1]) / 2;
  const double lowest = potential_[middle_index_];
  for (double& p : potential_) p -= lowest;
  for (std::size_t i = middle_index_; i < shift_.size(); ++i)
    right_.push_back(std::max(potential_[i], right_.empty() ? 0.0 : right_.back()));
  for (std::size_t i = middle_index_ + 1; i-- > 0;)
    left_.push_back(std::max(potential_[i], left_.empty() ? 0.0 : left_.back()));
}

/// Distance from the middle at which the potential first exceeds `energy`.
double KlingelWave::turning_point(double energy, bool right) const {
  const std::vector<double>& rising = right ? right_ : left_;
  const auto over =
      static_cast<std::size_t>(std::upper_bound(rising.begin(), rising.end(), energy) - rising.begin());
  if (over == 0 || over >= rising.size()) return kFineMm * static_cast<double>(rising.size() - 1);
  const double share = (energy - rising[over - 1]) / (rising[over] - rising[over - 1]);
  return kFineMm * (static_cast<double>(over - 1) + share);
}

std::optional<double> KlingelWave::tan_gamma_e(double amplitude_mm) const {
  constexpr int kHalvings = 50;
  constexpr double kShort = 1e-6;
  if (!middle_) return std::nullopt;
  double low = 0, high = std::min(left_.back(), right_.back());
  const auto reach = [&](double energy) {
    return (turning_point(energy, true) + turning_point(energy, false)) / 2;
  };
  if (reach(high) < amplitude_mm - kShort) return std::nullopt;
  for (int i = 0; i < kHalvings; ++i) {
    const double energy = (low + high) / 2;
    (reach(energy) < amplitude_mm ? low : high) = energy;
  }
  const double from = *middle_ - turning_point(high, false), to = *middle_ + turning_point(high, true);
  // Time over each step at its mean speed; y'' = -delta_r / 2, so that a cone's period is 2 pi / sqrt(gamma).
  double time = 0, last_speed = 0, last = from;
  const auto pass = [&](double at, double speed) {
    if (at > last) time += 2 * (at - last) / std::max(speed + last_speed, 1e-9);
    last = at, last_speed = speed;
  };
  for (std::size_t i = 0; i < shift_.size(); ++i)
    if (shift_[i] > from && shift_[i] < to)
      pass(shift_[i], std::sqrt(2 * std::max(0.0, high - potential_[i])));
  pass(to, 0);
  return std::pow(std::numbers::pi / time, 2);
}

}  // namespace lightstripe
