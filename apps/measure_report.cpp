// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/measure_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "apps/measurement_table.h"
#include "apps/section_drawing.h"

namespace lightstripe {
namespace {

constexpr const char* kStyle =
    "body{font:14px/1.45 sans-serif;max-width:1180px;margin:24px auto;padding:0 16px;color:#222}"
    "table{border-collapse:collapse;margin:8px 0}td,th{padding:3px 10px;border-bottom:1px solid "
    "#ddd;text-align:right}"
    "td:first-child,th:first-child{text-align:left}.fail{color:#c8401f;font-weight:bold}.strip{display:flex;"
    "flex-wrap:wrap;gap:12px}"
    "figure{margin:0;border:1px solid #ddd;padding:6px}figcaption{font-size:12px}svg text{font:11px "
    "sans-serif}";

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '&')
      out += "&amp;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

std::string cell(const Estimate* estimate) {
  if (!estimate) return "<td></td>";
  if (!estimate->value) return "<td title=\"" + escaped(estimate->reason) + "\">-</td>";
  return fmt::format("<td>{:.3f}</td>", *estimate->value);
}

std::string limit_text(const Bounds& bounds) {
  std::string text;
  if (bounds.low) text += fmt::format("&ge; {:g} ", *bounds.low);
  if (bounds.high) text += fmt::format("&le; {:g}", *bounds.high);
  return text;
}

std::vector<std::string> quantities(const MeasureReport& report) {
  std::vector<std::string> names = estimate_names(report.reference.kind());
  for (const std::string& name : extra_names(report.reference.kind())) names.push_back(name);
  return names;
}

Bounds drawn_bounds(const MeasureReport& report, const std::string& name) {
  if (name == "overlap_gap") return {-report.max_overlap_gap_mm, report.max_overlap_gap_mm};
  return bounds_of(name, report.limits);
}

std::string summary_table(const MeasureReport& report) {
  std::string html =
      "<table><tr><th>quantity</th><th>frames</th><th>lowest</th><th>mean</th><th>highest</th><th>limit</"
      "th></tr>";
  for (const std::string& name : quantities(report)) {
    const Spread spread = spread_of(report.rows, name);
    html += fmt::format("<tr><td>{}</td><td>{}</td>", name, spread.known);
    if (spread.known > 0) {
      html +=
          fmt::format("<td>{:.3f}</td><td>{:.3f}</td><td>{:.3f}</td>", spread.low, spread.mean, spread.high);
    } else {
      html += "<td></td><td>not known</td><td></td>";
    }
    html += "<td>" + limit_text(drawn_bounds(report, name)) + "</td></tr>";
  }
  return html + "</table>";
}

/// One quantity along the track: values with one sigma, limits in red.
std::string track_chart(const MeasureReport& report, const std::string& name) {
  constexpr double kWidth = 1100, kHeight = 130, kLeft = 60, kBottom = 20, kTop = 8;
  const Spread spread = spread_of(report.rows, name);
  if (spread.known < 2) return "";
  const Bounds bounds = drawn_bounds(report, name);
  double low = spread.low, high = spread.high;
  for (const auto& limit : {bounds.low, bounds.high})
    if (limit) low = std::min(low, *limit), high = std::max(high, *limit);
  const double margin = std::max(0.02, 0.08 * (high - low));
  low -= margin, high += margin;
  double first = report.rows.front().travel, last = first;
  for (const MeasuredFrame& row : report.rows)
    first = std::min(first, row.travel), last = std::max(last, row.travel);
  const bool by_frame = !(last > first);
  if (by_frame) first = 0, last = std::max(1.0, static_cast<double>(report.rows.size()) - 1);
  const auto x = [&](double s) { return kLeft + (s - first) / (last - first) * (kWidth - kLeft - 10); };
  const auto y = [&](double value) {
    return kTop + (high - value) / (high - low) * (kHeight - kTop - kBottom);
  };
  std::string svg = fmt::format("<h3>{}</h3><svg width=\"{}\" height=\"{}\">", name, kWidth, kHeight);
  svg += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"#fafafa\" stroke=\"#ccc\"/>",
                     kLeft, kTop, kWidth - kLeft - 10, kHeight - kTop - kBottom);
  for (const double value : {low + margin, high - margin})
    svg += fmt::format("<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{:.3f}</text>", kLeft - 4,
                       y(value) + 4, value);
  svg += fmt::format(
      "<text x=\"{}\" y=\"{}\">{} {:g}</text><text x=\"{}\" y=\"{}\" text-anchor=\"end\">{:g}</text>", kLeft,
      kHeight - 5, by_frame ? "frame" : "travel", first, kWidth - 10, kHeight - 5, last);
  std::string sigmas, dots;
  for (std::size_t i = 0; i < report.rows.size(); ++i) {
    const Estimate* estimate = find_estimate(report.rows[i], name);
    if (!estimate || !estimate->value) continue;
    const double at = x(by_frame ? static_cast<double>(i) : report.rows[i].travel),
                 sigma = estimate->sigma.value_or(0);
    fmt::format_to(std::back_inserter(dots), "M{:.1f} {:.1f}h0", at, y(*estimate->value));
    fmt::format_to(std::back_inserter(sigmas), "M{0:.1f} {1:.1f}V{2:.1f}", at, y(*estimate->value - sigma),
                   y(*estimate->value + sigma));
  }
  svg += "<path d=\"" + sigmas + "\" stroke=\"#9bbcd8\" stroke-width=\"1\"/><path d=\"" + dots +
         "\" stroke=\"#1f5f99\" stroke-width=\"3\" stroke-linecap=\"round\"/>";
  for (const auto& limit : {bounds.low, bounds.high})
    if (limit)
      svg += fmt::format("<path d=\"M{} {:.1f}H{}\" stroke=\"#c8401f\" stroke-dasharray=\"5 3\"/>", kLeft,
                         y(*limit), kWidth - 10);
  return svg + "</svg>";
}

/// How bad a frame is: failed ones first, then by what wears.
double badness(const MeasureReport& report, std::size_t i) {
  double worst = 0;
  for (const char* name : {"vertical_wear", "side_wear", "corner45_wear", "tread_wear", "hollow"}) {
    const Estimate* estimate = find_estimate(report.rows[i], name);
    if (estimate && estimate->value) worst = std::max(worst, *estimate->value);
  }
  return worst + (report.verdicts[i] == "fail" ? 1e6 : report.rows[i].status != "ok" ? -1 : 0);
}

std::vector<std::size_t> worst_first(const MeasureReport& report) {
  std::vector<std::size_t> order(report.rows.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return badness(report, a) > badness(report, b); });
  return order;
}

std::string worst_table(const MeasureReport& report, const std::vector<std::size_t>& order) {
  constexpr std::size_t kRows = 15;
  std::string html = "<table><tr><th>frame</th><th>travel</th>";
  const std::vector<std::string> names = estimate_names(report.reference.kind());
  for (const std::string& name : names) html += "<th>" + name + "</th>";
  html += "<th>verdict</th><th>status</th></tr>";
  for (std::size_t k = 0; k < std::min(kRows, order.size()); ++k) {
    const MeasuredFrame& row = report.rows[order[k]];
    html += fmt::format("<tr><td><a href=\"#f{0}\">{0}</a></td><td>{1:g}</td>", row.frame, row.travel);
    for (const std::string& name : names) html += cell(find_estimate(row, name));
    const std::string& verdict = report.verdicts[order[k]];
    html += fmt::format("<td class=\"{0}\">{0}</td><td>{1}</td></tr>", verdict, escaped(row.status));
  }
  return html + "</table>";
}

/// The worst places and some evenly along the track, in the track's order.
std::string section_strip(const MeasureReport& report, const std::vector<std::size_t>& order) {
  constexpr std::size_t kWorst = 15, kEven = 12;
  constexpr int kWidthPx = 360;
  std::set<std::size_t> shown;
  for (std::size_t k = 0; k < std::min(kWorst, order.size()); ++k) shown.insert(order[k]);
  for (std::size_t k = 0; k < kEven; ++k) shown.insert(k * (report.rows.size() - 1) / (kEven - 1));
  std::string html = "<div class=\"strip\">";
  for (const std::size_t i : shown) {
    const MeasuredFrame& row = report.rows[i];
    const SectionDrawing drawing = draw_section(report.profiles[i], row, report.reference);
    html += fmt::format(
        "<figure id=\"f{0}\">{1}<figcaption>frame {0}, travel {2:g}: {3} (x {4:g})</figcaption></figure>",
        row.frame, section_svg(drawing, kWidthPx), row.travel, escaped(row.status), drawing.enlarged);
  }
  return html + "</div>";
}

}  // namespace

std::string measure_report_html(const MeasureReport& report) {
  const auto ok = std::count_if(report.rows.begin(), report.rows.end(),
                                [](const MeasuredFrame& r) { return r.status == "ok"; });
  const auto failed = std::count(report.verdicts.begin(), report.verdicts.end(), "fail");
  const std::vector<std::size_t> order = worst_first(report);
  std::string html =
      "<!DOCTYPE html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>lightstripe "
      "measure</title><style>";
  html += kStyle;
  html += fmt::format(
      "</style></head><body><h1>{} against {}</h1><p>{}: {} frames, {} measured completely, {} beyond a "
      "limit.</p>",
      report.reference.kind() == ObjectKind::kRail ? "Rail" : "Wheel", escaped(report.reference.name()),
      escaped(report.source), report.rows.size(), ok, failed);
  html += "<h2>Summary</h2>" + summary_table(report) +
          "<p>Lengths in mm, angles in degrees, areas in mm&sup2;.</p>";
  html += "<h2>Worst places first</h2>" + worst_table(report, order);
  html += "<h2>Along the track</h2><p>Dots: measured; bars: one predicted sigma; red: limits.</p>";
  for (const std::string& name : quantities(report)) html += track_chart(report, name);
  html +=
      "<h2>Sections</h2><p>Grey: the reference; black: measured; lines on the outline: the difference, "
      "enlarged as each "
      "caption says; red where metal is gone (more than 0.1 mm), blue where it stands out, green "
      "between.</p>";
  html += section_strip(report, order);
  return html + "</body></html>\n";
}

}  // namespace lightstripe
