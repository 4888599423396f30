// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/measurement_table.h"

#include <algorithm>

#include "io/number_text.h"
#include "io/tables.h"

namespace lightstripe {
namespace {

constexpr int kDecimals = 4;

void append_row(std::string& out, const MeasuredFrame& row, const std::string& verdict,
                const std::string& calibration_error) {
  append_integer(out, row.frame);
  out.push_back(',');
  append_decimals(out, row.travel, 6);
  out += ',' + csv_cell(row.nominal);
  for (const NamedEstimate& one : row.estimates) append_estimate(out, one.estimate, kDecimals);
  out.push_back(',');
  if (row.registration.num_points > 0) append_decimals(out, row.registration.rms_mm, 5);
  out.push_back(',');
  append_integer(out, row.registration.num_points);
  out += ',' + csv_cell(row.status);
  for (const NamedEstimate& one : row.extras) append_estimate(out, one.estimate, kDecimals);
  const std::string missing = missing_of(row);
  out += ',' + verdict + ',' + (missing.empty() ? "" : csv_cell(missing)) + ',' + calibration_error + '\n';
}

}  // namespace

void append_estimate(std::string& out, const Estimate& estimate, int decimals) {
  out.push_back(',');
  if (estimate.value) append_decimals(out, *estimate.value, decimals);
  out.push_back(',');
  if (estimate.value && estimate.sigma) append_decimals(out, *estimate.sigma, decimals + 1);
}

std::string missing_of(const MeasuredFrame& row) {
  std::string out;
  const auto add = [&](const NamedEstimate& one) {
    if (!one.estimate.value) out += (out.empty() ? "" : " | ") + one.name + ": " + one.estimate.reason;
  };
  for (const NamedEstimate& one : row.estimates) add(one);
  for (const NamedEstimate& one : row.extras) add(one);
  return out;
}

std::string measurement_table(const std::vector<MeasuredFrame>& rows, ObjectKind kind,
                              const std::vector<std::string>& extras,
                              const std::vector<std::string>& verdicts,
                              const std::string& calibration_error) {
  std::string out = "frame,travel,nominal";
  for (const std::string& name : estimate_names(kind)) out += ',' + name + ',' + name + "_sigma";
  out += ",fit_rms,fit_points,status";
  for (const std::string& name : extras) out += ',' + name + ',' + name + "_sigma";
  out += ",verdict,missing,calibration_error\n";
  for (std::size_t i = 0; i < rows.size(); ++i) append_row(out, rows[i], verdicts[i], calibration_error);
  return out;
}

const Estimate* find_estimate(const MeasuredFrame& row, const std::string& name) {
  for (const auto* list : {&row.estimates, &row.extras})
    for (const NamedEstimate& one : *list)
      if (one.name == name) return &one.estimate;
  return nullptr;
}

Spread spread_of(const std::vector<MeasuredFrame>& rows, const std::string& name) {
  Spread out;
  for (const MeasuredFrame& row : rows) {
    const Estimate* estimate = find_estimate(row, name);
    if (!estimate || !estimate->value) continue;
    const double value = *estimate->value;
    out.low = out.known == 0 ? value : std::min(out.low, value);
    out.high = out.known == 0 ? value : std::max(out.high, value);
    out.mean += value;
    ++out.known;
  }
  if (out.known > 0) out.mean /= out.known;
  return out;
}

}  // namespace lightstripe
