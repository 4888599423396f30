// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Rows of a comma-separated text by the names of their columns, with the line for messages.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lightstripe {

class CsvReader {
 public:
  /// Reads the file and finds the columns; an Error for a missing or doubled column, an empty file, a binary
  /// file.
  CsvReader(const std::filesystem::path& path, std::vector<std::string_view> columns);

  /// Goes to the next row; false at the end. An Error for a row that is too short or too long, or a broken
  /// quote.
  bool next();

  /// Cells of the current row by the position in `columns`; an Error for what is no finite number.
  const std::string& text(std::size_t column) const { return cells_[position_[column]]; }
  double number(std::size_t column) const;
  std::int64_t integer(std::size_t column) const;

  /// An Error at the current line.
  [[noreturn]] void fail(const std::string& what_is_wrong, const std::string& what_to_do) const;

 private:
  bool next_line(std::string_view& line);
  void split(std::string_view line);

  std::string file_;
  std::string content_;
  std::vector<std::string_view> columns_;
  std::vector<std::size_t> position_;  ///< of each column in a row
  std::vector<std::string> cells_;
  std::size_t at_ = 0;
  std::size_t num_cells_ = 0;
  std::int64_t line_number_ = 0;
};

}  // namespace lightstripe
