// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/board_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "calib/board/marker_cells.h"
#include "core/error.h"
#include "io/session_file.h"
#include "report/page.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

constexpr double kTextMm = 3, kLineMm = 5;  // height of the text and distance of its lines
constexpr double kBarMm = 50;
constexpr double kPointsPerMm = 72 / 25.4;

/// The cells of a marker, its upper left corner at `at`.
void add_marker(BoardDrawing& drawing, const MarkerCells& cells, const Vector2d& at, double side_mm) {
  const double cell = side_mm / cells.side;
  for (int y = 0; y < cells.side; ++y)
    for (int x = 0; x < cells.side; ++x)
      if (cells.black(x, y)) drawing.rectangles.push_back({at.x() + x * cell, at.y() + y * cell, cell, cell});
}

void add_squares(BoardDrawing& drawing, const Target& target) {
  int marker = 0;
  for (int y = -1; y < target.rows; ++y) {
    for (int x = -1; x < target.columns; ++x) {
      const Vector2d at = drawing.origin_mm + Vector2d(x * target.pitch_x, y * target.pitch_y);
      if ((x + y) % 2 == 0) {
        drawing.rectangles.push_back({at.x(), at.y(), target.pitch_x, target.pitch_y});
      } else if (target.type == TargetType::kCharuco) {
        const Vector2d gap =
            0.5 * (Vector2d(target.pitch_x, target.pitch_y) - Vector2d::Constant(target.marker_mm));
        add_marker(drawing, marker_cells(target.dictionary, marker++, 1), at + gap, target.marker_mm);
      }
    }
  }
}

/// Tag 0 at the lower left, black squares between the tags' corners.
void add_tags(BoardDrawing& drawing, const Target& target) {
  const double step = target.marker_mm + target.tag_gap_mm;
  const int columns = target.columns / 2, rows = target.rows / 2;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      add_marker(drawing, marker_cells("DICT_APRILTAG_36h11", (rows - 1 - row) * columns + column, 2),
                 drawing.origin_mm + step * Vector2d(column, row), target.marker_mm);
  for (int row = 0; row <= rows; ++row)
    for (int column = 0; column <= columns; ++column) {
      const Vector2d at =
          drawing.origin_mm + step * Vector2d(column, row) - Vector2d::Constant(target.tag_gap_mm);
      drawing.rectangles.push_back({at.x(), at.y(), target.tag_gap_mm, target.tag_gap_mm});
    }
}

void add_circles(BoardDrawing& drawing, const Target& target) {
  for (int i = 0; i < target.num_corners(); ++i) {
    const Vector2d at = drawing.origin_mm + target.corner(i);
    drawing.discs.push_back({at.x(), at.y(), target.circle_mm});
  }
}

std::string description(const Target& t, const std::string& aprilgrid_file) {
  const auto type = enum_name(t.type);
  if (t.type == TargetType::kAprilgrid)
    return fmt::format(
        "target: {{type: {}, file: {}}} (tagCols: {}, tagRows: {}, tagSize: {:g}, tagSpacing: {:g})", type,
        aprilgrid_file, t.columns / 2, t.rows / 2, t.marker_mm / 1000, t.tag_gap_mm / t.marker_mm);
  if (t.has_circles())
    return fmt::format("target: {{type: {}, grid: [{}, {}], pitch: {:g}, diameter: {:.4g}}}", type, t.columns,
                       t.rows, t.pitch_x, t.circle_mm);
  const std::string square = t.pitch_x == t.pitch_y ? fmt::format("{:g}", t.pitch_x)
                                                    : fmt::format("[{:g}, {:g}]", t.pitch_x, t.pitch_y);
  const std::string marker = t.type == TargetType::kCharuco
                                 ? fmt::format(", marker: {:g}, dictionary: {}", t.marker_mm, t.dictionary)
                                 : "";
  return fmt::format("target: {{type: {}, inner_corners: [{}, {}], square: {}{}}}", type, t.columns, t.rows,
                     square, marker);
}

/// A circle of diameter 2 r by four Bezier curves (error 0.03 % of r).
std::string pdf_disc(double x, double y, double r) {
  const double k = 0.5522847498 * r;
  return fmt::format(
      "{:.4f} {:.4f} m {:.4f} {:.4f} {:.4f} {:.4f} {:.4f} {:.4f} c {:.4f} {:.4f} {:.4f} {:.4f} {:.4f} {:.4f} "
      "c "
      "{:.4f} {:.4f} {:.4f} {:.4f} {:.4f} {:.4f} c {:.4f} {:.4f} {:.4f} {:.4f} {:.4f} {:.4f} c f\n",
      x + r, y, x + r, y + k, x + k, y + r, x, y + r, x - k, y + r, x - r, y + k, x - r, y, x - r, y - k,
      x - k, y - r, x, y - r, x + k, y - r, x + r, y - k, x + r, y);
}

/// The page's marks; PDF counts in points and upwards, which the first line's matrix turns into mm from the
/// top.
std::string pdf_content(const BoardDrawing& d) {
  std::string text = fmt::format("q {:.6f} 0 0 {:.6f} 0 {:.4f} cm 0 g\n", kPointsPerMm, -kPointsPerMm,
                                 d.height_mm * kPointsPerMm);
  for (const auto& r : d.rectangles)
    text += fmt::format("{:.4f} {:.4f} {:.4f} {:.4f} re f\n", r.x, r.y, r.width, r.height);
  for (const auto& c : d.discs) text += pdf_disc(c.x, c.y, 0.5 * c.diameter);
  text += "Q\n";
  for (std::size_t i = 0; i < d.lines.size(); ++i) {
    const double from_foot = kLineMm * static_cast<double>(d.lines.size() - i) - 1;
    text += fmt::format("BT /F1 {:.2f} Tf {:.2f} {:.2f} Td ({}) Tj ET\n", kTextMm * kPointsPerMm,
                        5 * kPointsPerMm, from_foot * kPointsPerMm, d.lines[i]);
  }
  return text;
}

}  // namespace

BoardDrawing draw_target(const Target& given, const std::string& aprilgrid_file) {
  constexpr double kMinMarginMm = 8;
  Target target = given;
  if (target.has_circles() && target.circle_mm == 0)
    target.circle_mm = 0.5 * target.pitch_x * (target.type == TargetType::kCircles ? 1 : std::sqrt(2.0));
  BoardDrawing drawing;
  drawing.lines = {
      description(target, aprilgrid_file),
      fmt::format("The bar above is {:g} mm long: print without scaling and measure it", kBarMm)};
  const Vector2d margin = target.border() + Vector2d::Constant(std::max(target.rim(), kMinMarginMm));
  drawing.origin_mm = margin;
  drawing.width_mm = std::max(target.extent().x() + 2 * margin.x(), 130.0);
  const double foot = kLineMm * static_cast<double>(drawing.lines.size()) + 5;
  drawing.height_mm = target.extent().y() + 2 * margin.y() + foot;
  drawing.rectangles.push_back({5, drawing.height_mm - foot + 1, kBarMm, 1});
  if (target.has_circles())
    add_circles(drawing, target);
  else if (target.type == TargetType::kAprilgrid)
    add_tags(drawing, target);
  else
    add_squares(drawing, target);
  return drawing;
}

std::string to_svg(const BoardDrawing& d) {
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.3f}mm\" height=\"{1:.3f}mm\" viewBox=\"0 0 "
      "{0:.3f} "
      "{1:.3f}\">\n<rect width=\"{0:.3f}\" height=\"{1:.3f}\" fill=\"white\"/>\n<g "
      "shape-rendering=\"crispEdges\">\n",
      d.width_mm, d.height_mm);
  for (const auto& r : d.rectangles)
    text += fmt::format("<rect x=\"{:.4f}\" y=\"{:.4f}\" width=\"{:.4f}\" height=\"{:.4f}\"/>\n", r.x, r.y,
                        r.width, r.height);
  text += "</g>\n";
  for (const auto& c : d.discs)
    text += fmt::format("<circle cx=\"{:.4f}\" cy=\"{:.4f}\" r=\"{:.4f}\"/>\n", c.x, c.y, 0.5 * c.diameter);
  for (std::size_t i = 0; i < d.lines.size(); ++i)
    text +=
        fmt::format("<text x=\"5\" y=\"{:.2f}\" font-family=\"sans-serif\" font-size=\"{:g}\">{}</text>\n",
                    d.height_mm - kLineMm * static_cast<double>(d.lines.size() - i) + 1, kTextMm,
                    html_escaped(d.lines[i]));
  return text + "</svg>\n";
}

std::string to_pdf(const BoardDrawing& d) {
  const std::string content = pdf_content(d);
  const std::vector<std::string> objects{
      "<< /Type /Catalog /Pages 2 0 R >>", "<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
      fmt::format(
          "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {:.4f} {:.4f}] /Contents 4 0 R /Resources << /Font "
          "<< /F1 5 0 R >> >> >>",
          d.width_mm * kPointsPerMm, d.height_mm * kPointsPerMm),
      fmt::format("<< /Length {} >>\nstream\n{}endstream", content.size(), content),
      "<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica >>"};
  std::string text = "%PDF-1.4\n", table;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    table += fmt::format("{:010d} 00000 n \n", text.size());
    text += fmt::format("{} 0 obj\n{}\nendobj\n", i + 1, objects[i]);
  }
  const std::size_t start = text.size();
  text +=
      fmt::format("xref\n0 {}\n0000000000 65535 f \n{}trailer\n<< /Size {} /Root 1 0 R >>\nstartxref\n{}\n",
                  objects.size() + 1, table, objects.size() + 1, start);
  return text + "%%EOF\n";
}

std::string board_file_text(const std::string& target, const std::filesystem::path& file) {
  const std::string kind = file.extension().string();
  if (!file.empty() && kind != ".svg" && kind != ".pdf")
    throw Error(file.string(), "is neither .svg nor .pdf", "name the format by the file's ending");
  const std::string standard = "{type: checkerboard, inner_corners: [11, 8], square: 10}";
  const std::string given = target.empty() ? standard : target;
  std::string aprilgrid;
  const Target board = read_target(given, "", &aprilgrid);
  const BoardDrawing drawing = draw_target(board, aprilgrid);
  return kind == ".pdf" ? to_pdf(drawing) : to_svg(drawing);
}

}  // namespace lightstripe
