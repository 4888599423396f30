// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/excel_csv.h"

#include <algorithm>

#include "io/number_text.h"

namespace lightstripe {
namespace {

void append_cell(std::string& out, std::string_view cell, bool quoted) {
  const bool is_fraction = !quoted && cell.find('.') != std::string_view::npos && parse_number(cell);
  if (is_fraction) {
    for (const char c : cell) out += c == '.' ? ',' : c;
  } else if (quoted || cell.find(';') != std::string_view::npos) {
    out.append("\"").append(cell).append("\"");
  } else {
    out.append(cell);
  }
}

}  // namespace

std::string excel_csv(std::string_view csv) {
  std::string out = "\xEF\xBB\xBF";
  out.reserve(csv.size() + csv.size() / 16);
  for (std::size_t at = 0; at < csv.size();) {
    const bool quoted = csv[at] == '"';
    std::size_t end = at;
    if (quoted) {  // doubled quotes inside stay doubled
      for (end = at + 1; end < csv.size(); ++end) {
        if (csv[end] != '"') continue;
        if (end + 1 >= csv.size() || csv[end + 1] != '"') break;
        ++end;
      }
      append_cell(out, csv.substr(at + 1, end - at - 1), true);
      ++end;
    } else {
      end = std::min(csv.find_first_of(",\r\n", at), csv.size());
      append_cell(out, csv.substr(at, end - at), false);
    }
    if (end >= csv.size()) break;
    if (csv[end] == '\r' && end + 1 < csv.size() && csv[end + 1] == '\n') ++end;
    out += csv[end] == ',' ? ";" : "\r\n";
    at = end + 1;
  }
  return out;
}

}  // namespace lightstripe
