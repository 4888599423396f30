// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/conicity_report.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "report/line_chart.h"
#include "report/page.h"
#include "report/page_text.h"

namespace lightstripe {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr std::array<const char*, kSides> kColour{"#c8651f", "#1f6fb2"}, kName{"left", "right"};

std::string conicity_chart(const ConicityJob& job, const Conicity& conicity) {
  ChartLine line{"tan gamma_e (band: 2 sigma)", "#1f6fb2", {}, {}, {}, false};
  for (const ConicityRow& row : conicity.rows) {
    line.x.push_back(row.y_mm), line.y.push_back(row.tan_gamma_e.value_or(kNothing));
    line.half.push_back(2 * row.sigma.value_or(0));
  }
  return line_chart_svg(
      {"Equivalent conicity", "amplitude, mm", "tan gamma_e", {line}, job.options.max_conicity});
}

std::string difference_chart(const Conicity& conicity) {
  ChartLine line{"", "#1f6fb2", {}, {}, {}, false};
  for (const WheelsetPlace& place : conicity.walk.places)
    line.x.push_back(place.shift_mm), line.y.push_back(place.radius_difference_mm());
  return line_chart_svg({"Rolling radius difference", "shift to the right, mm", "delta r, mm", {line}, {}});
}

template <class Of>
std::string contact_chart(const Conicity& conicity, const char* title, const char* unit, const Of& of) {
  LineChart chart{title, "shift to the right, mm", unit, {}, {}};
  for (std::size_t s = 0; s < kSides; ++s) {
    ChartLine line{kName[s], kColour[s], {}, {}, {}, true};
    for (const WheelsetPlace& place : conicity.walk.places)
      line.x.push_back(place.shift_mm), line.y.push_back(of(place.contact[s]));
    chart.lines.push_back(line);
  }
  return line_chart_svg(chart);
}

std::string facts(const ConicityJob& job, const Conicity& conicity) {
  std::string out = "<table>";
  const auto row = [&](const std::string& what, const std::string& value) {
    out += fmt::format("<tr><td>{}</td><td>{}</td></tr>", what, html_escaped(value));
  };
  const auto both = [](const std::string& left, const std::string& right) {
    return right.empty() || right == left ? left : left + " (left), " + right + " (right)";
  };
  row("wheels", both(job.wheel, job.wheel_right));
  row("rails", both(job.rail, job.rail_right));
  row("gauge, back to back",
      fmt::format("{:g} mm, {:g} mm", job.options.gauge_mm, job.options.back_to_back_mm));
  if (conicity.at_3_mm)
    row("tan gamma_e at 3 mm",
        fmt::format("{:.4f}, sigma {:.4f}", *conicity.at_3_mm, conicity.at_3_mm_sigma.value_or(0)));
  if (conicity.nonlinearity_per_mm)
    row("nonlinearity, per mm (own definition: tan gamma_e at 4 mm less that at 2 mm, over 2 mm)",
        fmt::format("{:.4f}", *conicity.nonlinearity_per_mm));
  if (!conicity.verdict.empty()) row("verdict", conicity.verdict);
  if (!conicity.note.empty()) row("the table ends early", conicity.note);
  for (const ContactJump& jump : conicity.jumps)
    row(fmt::format("jump of the {} contact", kName[jump.side == TrackSide::kLeft ? 0 : 1]),
        fmt::format("at a shift of {:.2f} mm, on the rail from {:.1f} to {:.1f} mm", jump.shift_mm,
                    jump.from_mm, jump.to_mm));
  return out + "</table>";
}

}  // namespace

std::string conicity_report_html(const ConicityJob& job, const Conicity& conicity) {
  std::string body = "<h1>Equivalent conicity</h1>" + facts(job, conicity) + "<div class=\"strip\">";
  for (const std::string& chart :
       {conicity_chart(job, conicity), difference_chart(conicity),
        contact_chart(conicity, "Contact on the rails", "from the rail's origin outwards, mm",
                      [](const ContactPoint& p) { return p.rail_y_mm; }),
        contact_chart(conicity, "Contact on the wheels", "from the tread datum outwards, mm",
                      [](const ContactPoint& p) { return p.wheel_y_mm; }),
        contact_chart(conicity, "Contact angle", "degrees",
                      [](const ContactPoint& p) { return std::atan(p.slope) * 180 / std::numbers::pi; })})
    body += "<figure>" + chart + "</figure>";
  return page("Equivalent conicity", body + "</div>");
}

}  // namespace lightstripe
