// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/artefact_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "report/line_chart.h"
#include "report/page.h"
#include "report/page_text.h"

namespace lightstripe {
namespace {

std::string chart_of(const std::vector<ArtefactCheck>& history) {
  ChartLine line{"error (band: 2 sigma)", "#1f6fb2", {}, {}, {}, false};
  ChartLine dots{"", "#1f6fb2", {}, {}, {}, true}, zero{"", "#999", {}, {}, {}, false};
  for (std::size_t i = 0; i < history.size(); ++i) {
    const auto number = static_cast<double>(i + 1);
    line.x.push_back(number), line.y.push_back(history[i].error_mm),
        line.half.push_back(2 * history[i].sigma_mm);
    dots.x.push_back(number), dots.y.push_back(history[i].error_mm);
    zero.x.push_back(number), zero.y.push_back(0);
  }
  return line_chart_svg({"Error of the size", "check", "mm", {zero, line, dots}, {}});
}

std::string table_of(const std::vector<ArtefactCheck>& history) {
  std::string out =
      "<table><tr><th>check</th><th>time</th><th>rig</th><th>measured, "
      "mm</th><th>error</th><th>sigma</th><th>limit</"
      "th><th>drift</th><th>verdict</th></tr>";
  for (std::size_t i = history.size(); i-- > 0;) {
    const ArtefactCheck& c = history[i];
    out += fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{}</td><td>{:.4f}</td><td>{:+.4f}</td><td>{:.4f}</td><td>{:.4f}</"
        "td><td>{}</td><td>{}</td></tr>",
        i + 1, html_escaped(c.time), html_escaped(c.rig), c.measured_mm, c.error_mm, c.sigma_mm, c.limit_mm,
        c.drift_mm ? fmt::format("{:+.4f} (sigma {:.4f})", *c.drift_mm, c.drift_sigma_mm.value_or(0)) : "",
        html_escaped(c.verdict));
  }
  return out + "</table>";
}

}  // namespace

std::string artefact_report_html(const std::vector<ArtefactCheck>& history) {
  LIGHTSTRIPE_CHECK(!history.empty(), "a report of no check");
  const ArtefactCheck& last = history.back();
  const std::string title =
      fmt::format("Checks with the {} of {:g} mm", html_escaped(last.artefact), last.size_mm);
  return page(
      title, fmt::format("<h1>{}</h1><p>Last check, {}: <b>{}</b>, {:.4f} mm, error {:+.4f} mm, sigma {:.4f} "
                         "mm.</p><figure>{}</figure>{}",
                         title, html_escaped(last.time), html_escaped(last.verdict), last.measured_mm,
                         last.error_mm, last.sigma_mm, chart_of(history), table_of(history)));
}

}  // namespace lightstripe
