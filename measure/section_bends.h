// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What a calibration's error does to a measured frame: it is common to all frames of a scan, and no scatter
// shows it.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/section_bends.h"
#include "measure/features.h"
#include "measure/measure_profile.h"

namespace lightstripe {

/// The profile with u, v as they would be if the calibration erred by `bend` as well.
Profile bent(const Profile& profile, const SectionBends& bends, std::size_t bend);

/// Adds to the sigma, in quadrature, what one bend does to the value; nothing where either value is unknown.
void add_bend(const Estimate& bent, Estimate& estimate);

/// Adds to each sigma of `row` what the bends do to its value: `bent_rows` are measured from the bent
/// profiles, one a bend (GUM 5.1.2, with differences in the place of derivatives). A wheel's radial and axial
/// deviation get nothing: they are differences to the scan's mean, out of which a common error falls.
void add_bends(const std::vector<MeasuredFrame>& bent_rows, MeasuredFrame& row);
void add_bends(const std::vector<MeasuredFeatures>& bent_rows, MeasuredFeatures& row);

/// Adds to the sigmas of `row` what the bends do to a section like it, `neighbour`, which was measured
/// `plain` and with them. False, and the row is as it was, where the neighbour does not know a sigma that the
/// row has.
bool borrow_bends(const MeasuredFrame& plain, const MeasuredFrame& neighbour, MeasuredFrame& row);

/// Whether a row has values that bends could change.
bool shows_anything(const MeasuredFrame& row);
bool shows_anything(const MeasuredFeatures& row);

/// The row `measure(std::nullopt)` with what `count` independent errors do to it: `measure(i)` is the row
/// under the i-th of them, of which only the values are looked at.
template <class Measure>
auto measure_with_errors(std::size_t count, const Measure& measure) {
  auto row = measure(std::optional<std::size_t>());
  if (!shows_anything(row)) return row;
  std::vector<decltype(row)> under_errors;
  for (std::size_t i = 0; i < count; ++i) under_errors.push_back(measure(std::optional(i)));
  add_bends(under_errors, row);
  return row;
}

}  // namespace lightstripe
