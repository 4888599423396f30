// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/section_bends.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace lightstripe {
namespace {

bool is_deviation(const std::string& name) { return name == "radial_deviation" || name == "axial_deviation"; }

void add_bend(const ConicityRow& bent, ConicityRow& row) {
  if (!bent.tan_gamma_e || !row.tan_gamma_e || !row.sigma) return;
  row.sigma = std::hypot(*row.sigma, *bent.tan_gamma_e - *row.tan_gamma_e);
}

/// False where it cannot be told.
bool borrow(const std::optional<double>& plain, const std::optional<double>& with,
            std::optional<double>& sigma) {
  if (!sigma) return true;
  if (!plain || !with) return false;
  sigma = std::sqrt(*sigma * *sigma + std::max(0.0, *with * *with - *plain * *plain));
  return true;
}

}  // namespace

Profile bent(const Profile& profile, const SectionBends& bends, std::size_t bend) {
  Profile out = profile;
  for (ProfilePoint& p : out.points) {
    const Eigen::Vector2d by = displacement(bends, bend, p.sensor, p.u, p.v);
    p.u += by.x(), p.v += by.y();
  }
  return out;
}

void add_bend(const Estimate& bent, Estimate& estimate) {
  if (!estimate.value || !estimate.sigma || !bent.value) return;
  estimate.sigma = std::hypot(*estimate.sigma, *bent.value - *estimate.value);
}

void add_bends(const std::vector<MeasuredFrame>& bent_rows, MeasuredFrame& row) {
  for (const MeasuredFrame& bent : bent_rows) {
    for (auto of : {&MeasuredFrame::estimates, &MeasuredFrame::extras})
      for (std::size_t i = 0; i < std::min((row.*of).size(), (bent.*of).size()); ++i)
        if (!is_deviation((row.*of)[i].name)) add_bend((bent.*of)[i].estimate, (row.*of)[i].estimate);
    for (std::size_t i = 0; i < std::min(row.conicity.size(), bent.conicity.size()); ++i)
      add_bend(bent.conicity[i], row.conicity[i]);
  }
}

void add_bends(const std::vector<MeasuredFeatures>& bent_rows, MeasuredFeatures& row) {
  for (const MeasuredFeatures& bent : bent_rows)
    for (std::size_t i = 0; i < row.quantities.size(); ++i) add_bend(bent.quantities[i], row.quantities[i]);
}

bool borrow_bends(const MeasuredFrame& plain, const MeasuredFrame& neighbour, MeasuredFrame& row) {
  MeasuredFrame out = row;
  for (auto of : {&MeasuredFrame::estimates, &MeasuredFrame::extras})
    for (std::size_t i = 0; i < (out.*of).size(); ++i)
      if (!borrow((plain.*of)[i].estimate.sigma, (neighbour.*of)[i].estimate.sigma,
                  (out.*of)[i].estimate.sigma))
        return false;
  for (std::size_t i = 0; i < out.conicity.size(); ++i)
    if (i >= plain.conicity.size() ||
        !borrow(plain.conicity[i].sigma, neighbour.conicity[i].sigma, out.conicity[i].sigma))
      return false;
  row = std::move(out);
  return true;
}

bool shows_anything(const MeasuredFrame& row) {
  return row.registration.usable() || (row.right_registration && row.right_registration->usable());
}
bool shows_anything(const MeasuredFeatures&) { return true; }

}  // namespace lightstripe
