// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// measurements.csv, and what is said of a whole run.
#pragma once

#include <string>
#include <vector>

#include "measure/measure_profile.h"

namespace lightstripe {

/// frame,travel,nominal, each quantity and its _sigma, fit_rms,fit_points,status, then what was added later:
/// extras with their _sigma, verdict, missing (which cells are empty and why), calibration_error (whether the
/// sigmas count it, see calibration_word()).
std::string measurement_table(const std::vector<MeasuredFrame>& rows, ObjectKind kind,
                              const std::vector<std::string>& extras,
                              const std::vector<std::string>& verdicts, const std::string& calibration_error);

/// ",value,sigma" with so many decimals of the value and one more of its sigma; empty cells where it is not
/// known.
void append_estimate(std::string& out, const Estimate& estimate, int decimals);

/// "side_wear: gauge face not seen | head_width: ..."; empty where all is known.
std::string missing_of(const MeasuredFrame& row);

/// The largest of a quantity over the frames, for the summary on stdout.
struct Spread {
  int known = 0;
  double low = 0, high = 0, mean = 0;
};
Spread spread_of(const std::vector<MeasuredFrame>& rows, const std::string& name);

/// The estimate of this name among the quantities and the extras; nothing if the row has none of it.
const Estimate* find_estimate(const MeasuredFrame& row, const std::string& name);

}  // namespace lightstripe
