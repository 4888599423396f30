// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Profiles of wheels and rails on disk -> equivalent conicity on disk.
#pragma once

#include <optional>
#include <string>

#include "measure/conicity.h"

namespace lightstripe {

struct ConicityJob {
  /// A built-in outline's name, an outline file, .ban .whl .mpt .prr .prw, or csv with `y_mm,z_mm`.
  std::string wheel, wheel_right;  ///< right: empty = the mirror image of the other
  std::string rail, rail_right;
  double inclination =
      40;  ///< outlines of rails lean inwards by 1:this; 0: not. Measured ones lie as they lie
  double gauge_point_mm = 14;
  std::optional<double> wheel_sigma_mm, rail_sigma_mm;  ///< of a measured point; none: told from its scatter
  double correlation_mm = 0;  ///< along a measured profile, over which points share their error
  ConicityOptions options;
  std::string output;    ///< conicity.csv
  std::string report;    ///< written by the caller: must not be an input either; empty: none
  std::string contacts;  ///< table of the contact points over the shift; empty: none
};

/// A rail or a wheel as its file has it. An Error for what cannot be read or is too short.
RollingProfile read_rolling_wheel(const std::string& source, const ConicityJob& job,
                                  std::optional<double> sigma_mm);
RollingProfile read_rolling_rail(const std::string& source, const ConicityJob& job,
                                 std::optional<double> sigma_mm);

/// Reads, computes and writes the tables (none where the result is not usable).
Conicity run_conicity(const ConicityJob& job);

/// "0.1746, sigma 0.0021"; "not known"; without a sigma where both outlines are nominal and the gauge is
/// exact.
std::string conicity_at_3_mm_text(const Conicity& conicity);

}  // namespace lightstripe
