// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/line_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lightstripe {
namespace {

struct Span {
  double low = 1e300, high = -1e300;
  void take(double value) {
    if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  }
  void open() {
    if (low > high) low = 0, high = 1;
    const double rim = high > low ? 0.04 * (high - low) : std::max(1e-3, 0.1 * std::abs(high));
    low -= rim, high += rim;
  }
};

/// 1, 2 or 5 times a power of ten, some six to the span.
double tick_step(const Span& span) {
  const double rough = (span.high - span.low) / 6, power = std::pow(10, std::floor(std::log10(rough)));
  for (const double step : {1.0, 2.0, 5.0})
    if (step * power >= rough) return step * power;
  return 10 * power;
}

/// Maps data to pixels.
struct Canvas {
  Span x, y;
  double left = 58, top = 26, width = 500, height = 240;

  double px(double value) const { return left + (value - x.low) / (x.high - x.low) * width; }
  double py(double value) const { return top + (y.high - value) / (y.high - y.low) * height; }
};

void add_axes(const LineChart& chart, const Canvas& c, std::string& out) {
  out += fmt::format(R"(<rect x="{}" y="{}" width="{}" height="{}" fill="none" stroke="#999"/>)", c.left,
                     c.top, c.width, c.height);
  const double x_step = tick_step(c.x), y_step = tick_step(c.y);
  for (double at = std::ceil(c.x.low / x_step) * x_step; at <= c.x.high; at += x_step)
    out += fmt::format(
        R"(<line x1="{0:.1f}" x2="{0:.1f}" y1="{1}" y2="{2}" stroke="#eee"/><text x="{0:.1f}" y="{3}" text-anchor="middle">{4:g}</text>)",
        c.px(at), c.top, c.top + c.height, c.top + c.height + 14, std::abs(at) < 1e-9 * x_step ? 0.0 : at);
  for (double at = std::ceil(c.y.low / y_step) * y_step; at <= c.y.high; at += y_step)
    out += fmt::format(
        R"(<line y1="{0:.1f}" y2="{0:.1f}" x1="{1}" x2="{2}" stroke="#eee"/><text x="{3}" y="{4:.1f}" text-anchor="end">{5:g}</text>)",
        c.py(at), c.left, c.left + c.width, c.left - 5, c.py(at) + 4,
        std::abs(at) < 1e-9 * y_step ? 0.0 : at);
  out += fmt::format(R"(<text x="{}" y="16" font-weight="bold">{}</text>)", c.left, chart.title);
  out += fmt::format(R"(<text x="{}" y="{}" text-anchor="middle">{}</text>)", c.left + c.width / 2,
                     c.top + c.height + 30, chart.x_name);
  out += fmt::format(
      R"svg(<text x="14" y="{0}" text-anchor="middle" transform="rotate(-90 14 {0})">{1}</text>)svg",
      c.top + c.height / 2, chart.y_name);
}

void add_band(const ChartLine& line, const Canvas& c, std::string& out) {
  if (line.half.size() != line.x.size()) return;
  std::string points;
  const auto add = [&](std::size_t i, double sign) {
    const double y = line.y[i] + sign * line.half[i];
    if (std::isfinite(y)) points += fmt::format("{:.1f},{:.1f} ", c.px(line.x[i]), c.py(y));
  };
  for (std::size_t i = 0; i < line.x.size(); ++i) add(i, 1);
  for (std::size_t i = line.x.size(); i-- > 0;) add(i, -1);
  out += fmt::format(R"(<polygon points="{}" fill="{}" opacity="0.2"/>)", points, line.colour);
}

void add_line(const ChartLine& line, const Canvas& c, std::string& out) {
  std::string path;
  bool pen_up = true;
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    if (!std::isfinite(line.y[i])) {
      pen_up = true;
      continue;
    }
    if (line.dots)
      out += fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="1.8" fill="{}"/>)", c.px(line.x[i]),
                         c.py(line.y[i]), line.colour);
    path += fmt::format("{}{:.1f} {:.1f}", pen_up ? "M" : "L", c.px(line.x[i]), c.py(line.y[i]));
    pen_up = false;
  }
  if (!line.dots)
    out += fmt::format(R"(<path d="{}" fill="none" stroke="{}" stroke-width="1.5"/>)", path, line.colour);
}

}  // namespace

std::string line_chart_svg(const LineChart& chart, int width_px, int height_px) {
  Canvas c;
  c.width = width_px - c.left - 14, c.height = height_px - c.top - 40;
  for (const ChartLine& line : chart.lines)
    for (std::size_t i = 0; i < line.x.size(); ++i) {
      const double half = line.half.size() == line.x.size() && std::isfinite(line.half[i]) ? line.half[i] : 0;
      c.x.take(line.x[i]), c.y.take(line.y[i] + half), c.y.take(line.y[i] - half);
    }
  if (chart.limit) c.y.take(*chart.limit);
  c.x.open(), c.y.open();
  std::string out =
      fmt::format(R"(<svg width="{}" height="{}" xmlns="http://www.w3.org/2000/svg">)", width_px, height_px);
  add_axes(chart, c, out);
  for (const ChartLine& line : chart.lines) add_band(line, c, out);
  for (const ChartLine& line : chart.lines) add_line(line, c, out);
  if (chart.limit)
    out += fmt::format(
        R"(<line x1="{0}" x2="{1}" y1="{2:.1f}" y2="{2:.1f}" stroke="#c8401f" stroke-dasharray="5 3"/>)",
        c.left, c.left + c.width, c.py(*chart.limit));
  double at = c.left + 8;
  for (const ChartLine& line : chart.lines) {
    if (line.name.empty()) continue;
    out += fmt::format(R"(<text x="{:.0f}" y="{:.0f}" fill="{}">{}</text>)", at, c.top + 14, line.colour,
                       line.name);
    at += 14 + 6.5 * static_cast<double>(line.name.size());
  }
  return out + "</svg>";
}

}  // namespace lightstripe
