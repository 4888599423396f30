// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/measure_text.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "core/counted.h"
#include "pipeline/measurement_table.h"
#include "report/calibration_error_text.h"

namespace lightstripe {
namespace {

void say_run_out(const RunOut& run_out, Messages& out) {
  const auto line = [&](const char* what, const Estimate& estimate) {
    if (estimate.value)
      out.say(fmt::format("{} run-out {:.3f} mm, sigma {:.3f}", what, *estimate.value,
                          estimate.sigma.value_or(0)));
  };
  line("radial", run_out.radial);
  line("axial", run_out.axial);
}

/// Three digits; what rounds to 0 has no sign.
std::string three_digits(double value) { return fmt::format("{:.3f}", std::abs(value) < 0.0005 ? 0 : value); }

}  // namespace

Messages describe_measurement(const MeasureJob& job, const MeasureResult& result) {
  Messages out;
  if (result.references.identified()) out.say("rail: " + result.references.identified()->name);
  for (const auto& warning : result.warnings) out.warn(warning);
  out.say(fmt::format("{:<18} {:>6} {:>10} {:>10} {:>10}", "", "frames", "lowest", "mean", "highest"));
  const auto say_spread = [&](const std::string& name) {
    const Spread spread = spread_of(result.rows, name);
    if (spread.known > 0)
      out.say(fmt::format("{:<18} {:>6} {:>10} {:>10} {:>10}", name, spread.known, three_digits(spread.low),
                          three_digits(spread.mean), three_digits(spread.high)));
  };
  for (const std::string& name : estimate_names(job.kind)) say_spread(name);
  for (const char* const name : {"overlap_gap", "gauge", "conicity"}) say_spread(name);
  if (result.run_out) say_run_out(*result.run_out, out);
  const Spread diameter = spread_of(result.rows, "diameter");
  if (diameter.known > 0 && !result.rig.file.empty() && !result.calibration.counted())
    out.say(
        "the diameter's sigma is twice that of the axis' place in the rig's calibration: a board seen over a "
        "few degrees fixes an "
        "axis half a metre away only to a millimetre; it is common to all frames");
  out.append(describe_calibration_error(result.rig, result.calibration, job.profiles));
  if (result.references.baselines_error_is_missing())
    out.say("the sigmas do not count the error of the baseline's own calibration: no record names its rig");
  std::map<std::string, int> reasons;
  for (const MeasuredFrame& row : result.rows)
    if (row.status != "ok") ++reasons[row.status];
  for (const auto& [reason, count] : reasons)
    out.warn(fmt::format("{} of {}: {}", count, counted(result.rows.size(), "frame"), reason));
  out.say(fmt::format("{} of {} ok -> {}", result.num_ok, counted(result.rows.size(), "frame"),
                      job.table.string()));
  if (result.usable() && result.num_ok == 0)
    out.warn(
        fmt::format("none of {} could be measured completely: what is not known is an empty cell "
                    "(--require names what you need)",
                    counted(result.rows.size(), "frame")));
  return out;
}

}  // namespace lightstripe
