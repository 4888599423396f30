// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/conicity_report.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "report/charts_page.h"

namespace lightstripe {
namespace {

constexpr std::array<const char*, kSides> kName{"left", "right"};

LineChart conicity_chart(const ConicityJob& job, const Conicity& conicity) {
  ChartLine line{"", {}, {}, {}, false};
  for (const ConicityRow& row : conicity.rows) {
    line.x.push_back(row.y_mm), line.y.push_back(row.tan_gamma_e.value_or(kNoValue));
    line.half.push_back(2 * row.sigma.value_or(0));
  }
  LineChart chart{"Equivalent conicity (band: two sigma)", "amplitude, mm", "tan gamma_e", {line}, {}, false};
  if (job.options.max_conicity) chart.limits.push_back(*job.options.max_conicity);
  return chart;
}

LineChart difference_chart(const Conicity& conicity) {
  ChartLine line{"", {}, {}, {}, false};
  for (const WheelsetPlace& place : conicity.walk.places)
    line.x.push_back(place.shift_mm), line.y.push_back(place.radius_difference_mm());
  return {"Rolling radius difference", "shift to the right, mm", "delta r, mm", {line}, {}, false};
}

template <class Of>
LineChart contact_chart(const Conicity& conicity, const char* title, const char* unit, const Of& of) {
  LineChart chart{title, "shift to the right, mm", unit, {}, {}, false};
  for (std::size_t s = 0; s < kSides; ++s) {
    ChartLine line{kName[s], {}, {}, {}, true};
    for (const WheelsetPlace& place : conicity.walk.places)
      line.x.push_back(place.shift_mm), line.y.push_back(of(place.contact[s]));
    chart.lines.push_back(line);
  }
  return chart;
}

std::vector<std::vector<std::string>> facts(const ConicityJob& job, const Conicity& conicity) {
  std::vector<std::vector<std::string>> rows;
  const auto both = [](const std::string& left, const std::string& right) {
    return right.empty() || right == left ? left : left + " (left), " + right + " (right)";
  };
  rows.push_back({"wheels", both(job.wheel, job.wheel_right)});
  rows.push_back({"rails", both(job.rail, job.rail_right)});
  rows.push_back({"gauge, back to back",
                  fmt::format("{:g} mm, {:g} mm", job.options.gauge_mm, job.options.back_to_back_mm)});
  if (conicity.nonlinearity_per_mm)
    rows.push_back({"nonlinearity (own definition: tan gamma_e at 4 mm less that at 2 mm, over 2 mm)",
                    fmt::format("{:.4f} per mm", *conicity.nonlinearity_per_mm)});
  for (const ContactJump& jump : conicity.jumps)
    rows.push_back({fmt::format("jump of the {} contact", kName[jump.side == TrackSide::kLeft ? 0 : 1]),
                    fmt::format("at a shift of {:.2f} mm, on the rail from {:.1f} to {:.1f} mm",
                                jump.shift_mm, jump.from_mm, jump.to_mm)});
  return rows;
}

std::string headline(const Conicity& conicity) {
  return "tan gamma_e at 3 mm: " + conicity_at_3_mm_text(conicity) +
         (conicity.verdict.empty() ? "" : ", " + conicity.verdict);
}

}  // namespace

std::string conicity_report_html(const ConicityJob& job, const Conicity& conicity) {
  ChartsPage page{"Equivalent conicity", headline(conicity), {}, {"", ""}, facts(job, conicity), {}, {}};
  if (!conicity.verdict.empty()) page.good = conicity.verdict == "pass";
  if (!conicity.note.empty()) page.notes.push_back("The table ends early: " + conicity.note + ".");
  page.charts = {conicity_chart(job, conicity), difference_chart(conicity),
                 contact_chart(conicity, "Contact on the rails", "from the rail's origin outwards, mm",
                               [](const ContactPoint& p) { return p.rail_y_mm; }),
                 contact_chart(conicity, "Contact on the wheels", "from the tread datum outwards, mm",
                               [](const ContactPoint& p) { return p.wheel_y_mm; }),
                 contact_chart(conicity, "Contact angle", "degrees", [](const ContactPoint& p) {
                   return std::atan(p.slope) * 180 / std::numbers::pi;
                 })};
  return charts_page_html(page);
}

}  // namespace lightstripe
