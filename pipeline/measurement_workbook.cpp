// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/measurement_workbook.h"

#include <fmt/format.h>
#include <xlsxwriter.h>

#include "core/error.h"
#include "io/atomic_file.h"
#include "pipeline/measurement_table.h"
#include "pipeline/quantity_text.h"

namespace lightstripe {
namespace {

constexpr std::uint32_t kChartRows = 15;  // of the sheet, a chart

lxw_row_t row_number(std::size_t i) { return static_cast<lxw_row_t>(i); }
lxw_col_t column_number(std::size_t i) { return static_cast<lxw_col_t>(i); }

struct Column {
  std::string name;    ///< of measurements.csv
  std::size_t at = 0;  ///< of its values; its sigmas are in the next one
};

class Workbook {
 public:
  explicit Workbook(const std::filesystem::path& path) : book_(workbook_new(path.c_str())) {
    lxw_doc_properties properties{};
    std::string title = "lightstripe measurements";
    properties.title = title.data();  // is copied
    properties.created = 1767225600;  // 1 January 2026 whenever it is made: same input, same bytes
    workbook_set_properties(book_, &properties);
    table_ = workbook_add_worksheet(book_, "measurements");
    charts_ = workbook_add_worksheet(book_, "charts");
    head_ = workbook_add_format(book_);
    format_set_bold(head_);
    format_set_text_wrap(head_);
    format_set_bottom(head_, LXW_BORDER_THIN);
    format_set_align(head_, LXW_ALIGN_VERTICAL_TOP);
  }
  ~Workbook() {
    if (book_) workbook_close(book_);
  }
  Workbook(const Workbook&) = delete;
  Workbook& operator=(const Workbook&) = delete;

  void head(std::size_t column, const std::string& text) {
    worksheet_write_string(table_, 0, column_number(column), text.c_str(), head_);
    worksheet_set_column(table_, column_number(column), column_number(column), 13, nullptr);
  }
  void number(std::size_t row, std::size_t column, double value, int decimals) {
    worksheet_write_number(table_, row_number(row), column_number(column), value, format_of(decimals));
  }
  void text(std::size_t row, std::size_t column, const std::string& value) {
    if (!value.empty())
      worksheet_write_string(table_, row_number(row), column_number(column), value.c_str(), nullptr);
  }
  void freeze_head() { worksheet_freeze_panes(table_, 1, 2); }

  /// Values over travel (or over the frame where nothing travels), with the limits as lines.
  void chart(std::size_t place, const Column& column, std::size_t rows, bool by_travel,
             const Bounds& bounds) {
    const QuantityText text = quantity_text(column.name);
    lxw_chart* chart = workbook_add_chart(book_, LXW_CHART_SCATTER_STRAIGHT_WITH_MARKERS);
    lxw_chart_series* series = chart_add_series(chart, nullptr, nullptr);
    const lxw_row_t last = row_number(rows);
    const lxw_col_t along = by_travel ? 1 : 0, values = column_number(column.at);
    chart_series_set_categories(series, "measurements", 1, along, last, along);
    chart_series_set_values(series, "measurements", 1, values, last, values);
    chart_series_set_name(series, text.label.c_str());
    chart_series_set_marker_type(series, LXW_CHART_MARKER_CIRCLE);
    chart_series_set_marker_size(series, 3);
    const std::string title = text.label + ", " + text.unit;
    std::string limits;
    if (bounds.low) limits += fmt::format("  (at least {:g})", *bounds.low);
    if (bounds.high) limits += fmt::format("  (at most {:g})", *bounds.high);
    chart_title_set_name(chart, (title + limits).c_str());
    chart_axis_set_name(chart->x_axis, by_travel ? "travel" : "frame");
    chart_axis_set_name(chart->y_axis, text.unit.c_str());
    chart_legend_set_position(chart, LXW_CHART_LEGEND_NONE);
    lxw_chart_options options{};
    options.x_scale = 1.6;
    worksheet_insert_chart_opt(charts_, row_number(place * kChartRows), 0, chart, &options);
  }

  void close(const std::filesystem::path& name) {
    const lxw_error error = workbook_close(book_);
    book_ = nullptr;
    if (error != LXW_NO_ERROR)
      throw Error(name.string(), lxw_strerror(error), "check the folder and the space left on the disk");
  }

 private:
  lxw_format* format_of(int decimals) {
    while (static_cast<int>(formats_.size()) <= decimals) {
      lxw_format* format = workbook_add_format(book_);
      const std::string digits = formats_.empty() ? "0" : "0." + std::string(formats_.size(), '0');
      format_set_num_format(format, digits.c_str());
      formats_.push_back(format);
    }
    return formats_[static_cast<std::size_t>(decimals)];
  }

  lxw_workbook* book_;
  lxw_worksheet *table_ = nullptr, *charts_ = nullptr;
  lxw_format* head_ = nullptr;
  std::vector<lxw_format*> formats_;
};

std::vector<Column> write_head(Workbook& book, ObjectKind kind, const std::vector<std::string>& extras) {
  std::vector<Column> columns;
  std::size_t at = 0;
  for (const char* const name : {"frame", "travel", "nominal"}) book.head(at++, name);
  const auto add = [&](const std::string& name) {
    const QuantityText text = quantity_text(name);
    columns.push_back({name, at});
    book.head(at++, fmt::format("{}, {}", text.label, text.unit));
    book.head(at++, "its sigma");
  };
  for (const std::string& name : estimate_names(kind)) add(name);
  for (const std::string& name : extras) add(name);
  for (const char* const name :
       {"fit rms, mm", "points of the fit", "status", "verdict", "not known, and why", "calibration's error"})
    book.head(at++, name);
  return columns;
}

void write_row(Workbook& book, std::size_t line, const MeasuredFrame& row, const std::vector<Column>& columns,
               const std::string& verdict, const std::string& calibration_error) {
  book.number(line, 0, static_cast<double>(row.frame), 0);
  book.number(line, 1, row.travel, 3);
  book.text(line, 2, row.nominal);
  for (const Column& column : columns) {
    const Estimate* estimate = find_estimate(row, column.name);
    if (!estimate || !estimate->value) continue;
    book.number(line, column.at, *estimate->value, 4);
    if (estimate->sigma) book.number(line, column.at + 1, *estimate->sigma, 5);
  }
  const std::size_t behind = columns.empty() ? 3 : columns.back().at + 2;
  if (row.registration.num_points > 0) book.number(line, behind, row.registration.rms_mm, 5);
  book.number(line, behind + 1, row.registration.num_points, 0);
  book.text(line, behind + 2, row.status);
  book.text(line, behind + 3, verdict);
  book.text(line, behind + 4, missing_of(row));
  book.text(line, behind + 5, calibration_error);
}

}  // namespace

void write_measurement_workbook(const std::filesystem::path& path, const std::vector<MeasuredFrame>& rows,
                                ObjectKind kind, const std::vector<std::string>& extras,
                                const std::vector<std::string>& verdicts, const Limits& limits,
                                const std::string& calibration_error) {
  AtomicFile file(path);
  Workbook book(file.temporary());
  const std::vector<Column> columns = write_head(book, kind, extras);
  bool by_travel = false;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    write_row(book, i + 1, rows[i], columns, verdicts[i], calibration_error);
    by_travel = by_travel || rows[i].travel != rows.front().travel;
  }
  book.freeze_head();
  std::size_t place = 0;
  for (const Column& column : columns)
    if (spread_of(rows, column.name).known > 1)
      book.chart(place++, column, rows.size(), by_travel, bounds_of(column.name, limits));
  book.close(path);
  file.commit();
}

}  // namespace lightstripe
