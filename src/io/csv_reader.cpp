// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/csv_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/number_text.h"

namespace lightstripe {
namespace {

constexpr std::size_t kMaxFileBytes = std::size_t{1} << 34;
constexpr std::size_t kMaxLineLength = std::size_t{1} << 16;
constexpr std::size_t kMaxShown = 40;

std::string_view trimmed(std::string_view text) {
  constexpr const char* kBlanks = " \t\r";
  const std::size_t start = text.find_first_not_of(kBlanks);
  if (start == std::string_view::npos) return {};
  return text.substr(start, text.find_last_not_of(kBlanks) + 1 - start);
}

}  // namespace

CsvReader::CsvReader(const std::filesystem::path& path, std::vector<std::string_view> columns)
    : file_(path.string()), content_(read_file(path, kMaxFileBytes)), columns_(std::move(columns)) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (std::string_view(content_).substr(0, 3) == kByteOrderMark) at_ = 3;
  std::string_view line;
  const std::string wanted =
      fmt::format("the first line has to name the columns {}", fmt::join(columns_, ","));
  if (!next_line(line)) throw Error(file_, "is empty", wanted);
  split(line);
  num_cells_ = cells_.size();
  for (const std::string_view column : columns_) {
    const auto found = std::find(cells_.begin(), cells_.end(), column);
    if (found == cells_.end()) {
      const bool semicolons = line.find(';') != std::string_view::npos && num_cells_ == 1;
      fail(fmt::format("no column '{}'", column), semicolons ? "separate the columns by commas" : wanted);
    }
    if (std::find(found + 1, cells_.end(), column) != cells_.end())
      fail(fmt::format("two columns '{}'", column), "keep one of the two");
    position_.push_back(static_cast<std::size_t>(found - cells_.begin()));
  }
}

void CsvReader::fail(const std::string& what_is_wrong, const std::string& what_to_do) const {
  throw Error(fmt::format("{}:{}", file_, line_number_), what_is_wrong, what_to_do);
}

/// The next line that holds something, blanks at its ends cut off.
bool CsvReader::next_line(std::string_view& line) {
  while (at_ < content_.size()) {
    const std::size_t end = std::min(content_.find('\n', at_), content_.size());
    line = trimmed(std::string_view(content_).substr(at_, end - at_));
    at_ = end + 1;
    ++line_number_;
    if (line.size() > kMaxLineLength)
      fail("is longer than 65536 characters", "check that it is the right file");
    if (line.find('\0') != std::string_view::npos) fail("is not text", "check that it is the right file");
    if (!line.empty() && line.front() != '#') return true;
  }
  return false;
}

/// RFC 4180, section 2, within one line: a cell in quotes may hold commas, and quotes written twice.
void CsvReader::split(std::string_view line) {
  std::size_t count = 0;
  for (std::size_t at = 0; at <= line.size(); ++count) {
    if (count == cells_.size()) cells_.emplace_back();
    std::string& cell = cells_[count];
    if (at < line.size() && line[at] == '"') {
      cell.clear();
      for (++at; at < line.size() && (line[at] != '"' || line.substr(at, 2) == "\"\""); ++at) {
        cell.push_back(line[at]);
        if (line[at] == '"') ++at;
      }
      if (at == line.size() || (at + 1 < line.size() && line[at + 1] != ','))
        fail("a quoted cell does not end", "close it with \" before the comma");
      at += 2;
    } else {
      const std::size_t end = std::min(line.find(',', at), line.size());
      cell.assign(trimmed(line.substr(at, end - at)));
      at = end + 1;
    }
  }
  cells_.resize(count);
}

bool CsvReader::next() {
  std::string_view line;
  if (!next_line(line)) return false;
  split(line);
  if (cells_.size() != num_cells_)
    fail(fmt::format("has {} cells, the first line {}", cells_.size(), num_cells_), "complete the row");
  return true;
}

double CsvReader::number(std::size_t column) const {
  const auto value = parse_number(text(column));
  if (!value) {
    fail(fmt::format("{} is '{}'", columns_[column], text(column).substr(0, kMaxShown)),
         "give a finite number with a decimal point");
  }
  return *value;
}

std::int64_t CsvReader::integer(std::size_t column) const {
  const auto value = parse_integer(text(column));
  if (!value)
    fail(fmt::format("{} is '{}'", columns_[column], text(column).substr(0, kMaxShown)),
         "give a whole number");
  return *value;
}

}  // namespace lightstripe
