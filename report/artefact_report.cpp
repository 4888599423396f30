// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/artefact_report.h"

#include <fmt/format.h>

#include <cmath>

#include <algorithm>

#include "core/error.h"
#include "report/charts_page.h"

namespace lightstripe {
namespace {

LineChart chart_of(const std::vector<ArtefactCheck>& history) {
  ChartLine line{"", {}, {}, {}, false};
  for (std::size_t i = 0; i < history.size(); ++i) {
    line.x.push_back(static_cast<double>(i + 1)), line.y.push_back(history[i].error_mm);
    line.half.push_back(2 * history[i].sigma_mm);
  }
  const double limit = history.back().limit_mm;
  return {"Error of the size (band: two sigma)", "check", "mm", {line}, {-limit, limit}, false};
}

std::vector<std::string> row_of(const std::vector<ArtefactCheck>& history, std::size_t i) {
  const ArtefactCheck& c = history[i];
  const auto drift =
      c.drift_mm ? fmt::format("{} (sigma {:.4f})",
                               std::abs(*c.drift_mm) < 5e-5 ? "0.0000" : fmt::format("{:+.4f}", *c.drift_mm),
                               c.drift_sigma_mm.value_or(0))
                 : "-";
  return {fmt::format("{}", i + 1),
          c.time,
          c.rig,
          fmt::format("{:.4f}", c.measured_mm),
          fmt::format("{:+.4f}", c.error_mm),
          fmt::format("{:.4f}", c.sigma_mm),
          fmt::format("{:.4f}", c.limit_mm),
          drift,
          c.verdict};
}

}  // namespace

std::string artefact_report_html(const std::vector<ArtefactCheck>& history) {
  LIGHTSTRIPE_CHECK(!history.empty(), "a report of no check");
  const ArtefactCheck& last = history.back();
  ChartsPage page{fmt::format("Checks with the {} of {:g} mm", last.artefact, last.size_mm),
                  fmt::format("Last check, {}: {}; {:.4f} mm, error {:+.4f} mm, sigma {:.4f} mm", last.time,
                              last.verdict == "pass" ? "passed" : "failed", last.measured_mm, last.error_mm,
                              last.sigma_mm),
                  last.verdict == "pass",
                  {"check", "time", "rig", "measured, mm", "error", "sigma", "limit", "drift", "verdict"},
                  {},
                  {},
                  {chart_of(history)}};
  for (std::size_t i = history.size(); i-- > 0;) page.rows.push_back(row_of(history, i));
  return charts_page_html(page);
}

}  // namespace lightstripe
