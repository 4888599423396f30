// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/measure_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

#include "pipeline/frame_links.h"
#include "pipeline/measurement_table.h"
#include "report/page_text.h"
#include "report/section_drawing.h"

namespace lightstripe {
namespace {

constexpr std::size_t kWorst = 15;  // places in the table

struct MeasureReport {
  const MeasureJob& job;
  const MeasureResult& result;
  const std::filesystem::path &page, &scan_file;
};

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
  std::vector<std::string> names = estimate_names(report.job.kind);
  for (const std::string& name : report.result.extra_columns) names.push_back(name);
  return names;
}

Bounds drawn_bounds(const MeasureReport& report, const std::string& name) {
  if (name == "overlap_gap" || name == "right_overlap_gap")
    return {-report.job.options.max_overlap_gap_mm, report.job.options.max_overlap_gap_mm};
  return bounds_of(name, report.job.limits);
}

std::string run_out_text(const char* what, const Estimate& run_out) {
  if (!run_out.value) return fmt::format("<p>{} run-out: not known ({}).</p>", what, escaped(run_out.reason));
  return fmt::format(
      "<p>{} run-out: <b>{:.3f}</b> mm, predicted sigma {:.3f} (highest less lowest of a whole turn).</p>",
      what, *run_out.value, run_out.sigma.value_or(0));
}

std::string summary_table(const MeasureReport& report) {
  std::string html =
      "<table><tr><th>quantity</th><th>frames</th><th>lowest</th><th>mean</th><th>highest</th><th>limit</"
      "th></tr>";
  for (const std::string& name : quantities(report)) {
    const Spread spread = spread_of(report.result.rows, name);
    html += fmt::format("<tr><td>{}</td><td>{}</td>", name, spread.known);
    if (spread.known > 0) {
      html +=
          fmt::format("<td>{:.3f}</td><td>{:.3f}</td><td>{:.3f}</td>", spread.low, spread.mean, spread.high);
    } else {
      html += "<td></td><td>not known</td><td></td>";
    }
    html += "<td>" + limit_text(drawn_bounds(report, name)) + "</td></tr>";
  }
  html += "</table>";
  if (report.result.run_out)
    html += run_out_text("Radial", report.result.run_out->radial) +
            run_out_text("Axial", report.result.run_out->axial);
  return html;
}

/// One quantity along the track: values with one sigma, limits in red.
std::string track_chart(const MeasureReport& report, const std::string& name) {
  constexpr double kWidth = 1100, kHeight = 130, kLeft = 60, kBottom = 20, kTop = 8;
  const Spread spread = spread_of(report.result.rows, name);
  if (spread.known < 2) return "";
  const Bounds bounds = drawn_bounds(report, name);
  double low = spread.low, high = spread.high;
  for (const auto& limit : {bounds.low, bounds.high})
    if (limit) low = std::min(low, *limit), high = std::max(high, *limit);
  const double margin = std::max(0.02, 0.08 * (high - low));
  low -= margin, high += margin;
  double first = report.result.rows.front().travel, last = first;
  for (const MeasuredFrame& row : report.result.rows)
    first = std::min(first, row.travel), last = std::max(last, row.travel);
  const bool by_frame = !(last > first);
  if (by_frame) first = 0, last = std::max(1.0, static_cast<double>(report.result.rows.size()) - 1);
  const auto x = [&](double s) { return kLeft + (s - first) / (last - first) * (kWidth - kLeft - 10); };
  const auto y = [&](double value) {
    return kTop + (high - value) / (high - low) * (kHeight - kTop - kBottom);
  };
  std::string svg = fmt::format("<h3>{}</h3><svg width=\"{}\" height=\"{}\">", name, kWidth, kHeight);
  svg += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"#fafafa\" stroke=\"#ccc\"/>",
                     kLeft, kTop, kWidth - kLeft - 10, kHeight - kTop - kBottom);
  for (const double value : {low, high})
    svg += fmt::format("<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{:.3f}</text>", kLeft - 4,
                       y(value) + 4, value);
  svg += fmt::format(
      "<text x=\"{}\" y=\"{}\">{} {:g}</text><text x=\"{}\" y=\"{}\" text-anchor=\"end\">{:g}</text>", kLeft,
      kHeight - 5, by_frame ? "frame" : "travel", first, kWidth - 10, kHeight - 5, last);
  std::string sigmas, dots;
  for (std::size_t i = 0; i < report.result.rows.size(); ++i) {
    const Estimate* estimate = find_estimate(report.result.rows[i], name);
    if (!estimate || !estimate->value) continue;
    const double at = x(by_frame ? static_cast<double>(i) : report.result.rows[i].travel),
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
    const Estimate* estimate = find_estimate(report.result.rows[i], name);
    if (estimate && estimate->value) worst = std::max(worst, *estimate->value);
  }
  return worst + (report.result.verdicts[i] == "fail" ? 1e6 : report.result.rows[i].status != "ok" ? -1 : 0);
}

std::vector<std::size_t> worst_first(const MeasureReport& report) {
  std::vector<std::size_t> order(report.result.rows.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return badness(report, a) > badness(report, b); });
  return order;
}

using FrameLinks = std::map<std::int64_t, std::vector<FrameLink>>;

std::string link_text(const FrameLinks& links, std::int64_t frame) {
  std::string html;
  if (const auto found = links.find(frame); found != links.end())
    for (const FrameLink& link : found->second)
      html +=
          fmt::format("{}<a href=\"{}\">{}</a>", html.empty() ? "" : " ", link.href, escaped(link.sensor));
  return html;
}

std::string worst_table(const MeasureReport& report, const std::vector<std::size_t>& order,
                        const FrameLinks& links) {
  std::string html = "<table><tr><th>frame</th><th>travel</th>";
  const std::vector<std::string> names = estimate_names(report.job.kind);
  for (const std::string& name : names) html += "<th>" + name + "</th>";
  html += fmt::format("<th>verdict</th><th>status</th>{}</tr>", links.empty() ? "" : "<th>pictures</th>");
  for (std::size_t k = 0; k < std::min(kWorst, order.size()); ++k) {
    const MeasuredFrame& row = report.result.rows[order[k]];
    html += fmt::format("<tr><td><a href=\"#f{0}\">{0}</a></td><td>{1:g}</td>", row.frame, row.travel);
    for (const std::string& name : names) html += cell(find_estimate(row, name));
    const std::string& verdict = report.result.verdicts[order[k]];
    html += fmt::format("<td class=\"{0}\">{0}</td><td>{1}</td>", verdict, escaped(row.status));
    if (!links.empty()) html += "<td>" + link_text(links, row.frame) + "</td>";
    html += "</tr>";
  }
  return html + "</table>";
}

/// The worst places and some evenly along the track, in the track's order.
std::set<std::size_t> drawn_sections(const MeasureReport& report, const std::vector<std::size_t>& order) {
  constexpr std::size_t kEven = 12;
  std::set<std::size_t> shown(order.begin(),
                              order.begin() + static_cast<std::ptrdiff_t>(std::min(kWorst, order.size())));
  for (std::size_t k = 0; k < kEven; ++k) shown.insert(k * (report.result.rows.size() - 1) / (kEven - 1));
  return shown;
}

/// Of a track: the left rail, then the right one.
std::string section_figure(const MeasureReport& report, std::size_t i, const FrameLinks& links) {
  constexpr int kWidthPx = 360;
  const MeasuredFrame& row = report.result.rows[i];
  const SectionDrawing drawing = draw_section(report.result.input.profiles[i], row.registration,
                                              report.result.references.at(row.travel));
  std::string html = fmt::format("<figure id=\"f{}\">{}", row.frame, section_svg(drawing, kWidthPx));
  if (row.right_registration)
    html += section_svg(draw_section(report.result.input.profiles[i], *row.right_registration,
                                     report.result.references.right()),
                        kWidthPx);
  const std::string pictures = link_text(links, row.frame);
  return html + fmt::format("<figcaption>frame {}, travel {:g}: {} (x {:g}){}{}</figcaption></figure>",
                            row.frame, row.travel, escaped(row.status), drawing.enlarged,
                            pictures.empty() ? "" : "<br>", pictures);
}

FrameLinks links_of(const MeasureReport& report, const std::set<std::size_t>& shown) {
  if (report.scan_file.empty()) return {};
  std::vector<std::int64_t> frames;
  for (const std::size_t i : shown) frames.push_back(report.result.rows[i].frame);
  return frame_links(report.scan_file.string(), report.job.rig.string(), report.page, frames);
}

}  // namespace

std::string measure_report_html(const MeasureJob& job, const MeasureResult& result,
                                const std::filesystem::path& page, const std::filesystem::path& scan_file) {
  const MeasureReport report{job, result, page, scan_file};
  const auto ok = std::count_if(report.result.rows.begin(), report.result.rows.end(),
                                [](const MeasuredFrame& r) { return r.status == "ok"; });
  const auto failed = std::count(report.result.verdicts.begin(), report.result.verdicts.end(), "fail");
  const std::vector<std::size_t> order = worst_first(report);
  const std::set<std::size_t> shown = drawn_sections(report, order);
  const FrameLinks links = links_of(report, shown);
  std::string html =
      "<!DOCTYPE html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>lightstripe "
      "measure</title><style>";
  html += page_style();
  html += fmt::format(
      "</style></head><body><h1>{} against {}</h1><p>{}: {} frames, {} measured completely, {} beyond a "
      "limit.</p>",
      report.job.kind == ObjectKind::kRail ? "Rail" : "Wheel",
      escaped(report.result.references.at(report.result.rows.front().travel).name()),
      escaped(report.job.profiles.string()), report.result.rows.size(), ok, failed);
  html += "<h2>Summary</h2>" + summary_table(report) +
          "<p>Lengths in mm, angles in degrees, areas in mm&sup2;.</p>";
  html += "<h2>Worst places first</h2>" + worst_table(report, order, links);
  html +=
      "<h2>Along the scan</h2><p>Travel in mm, of a turning wheel in degrees. Dots: measured; bars: one "
      "predicted sigma; red: limits.</p>";
  for (const std::string& name : quantities(report)) html += track_chart(report, name);
  html +=
      "<h2>Sections</h2><p>Grey: the reference; black: measured; lines on the outline: the difference, "
      "enlarged as each "
      "caption says; red where metal is gone (more than 0.1 mm), blue where it stands out, green "
      "between.</p>";
  html += "<div class=\"strip\">";
  for (const std::size_t i : shown) html += section_figure(report, i, links);
  return html + "</div></body></html>\n";
}

}  // namespace lightstripe
