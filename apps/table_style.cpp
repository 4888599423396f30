// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/table_style.h"

#include <map>
#include <string>

#include "io/atomic_file.h"
#include "io/excel_csv.h"

namespace lightstripe {

void add_table_style_option(CLI::App& command, TableStyle& style) {
  command
      .add_option("--csv-style", style,
                  "plain, or excel: semicolons, decimal commas and a byte order mark [plain]")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, TableStyle>{{"plain", TableStyle::kPlain}, {"excel", TableStyle::kExcel}}));
}

void apply_table_style(const std::filesystem::path& table, TableStyle style) {
  if (style == TableStyle::kExcel && table.extension() == ".csv")
    write_file(table, excel_csv(read_file(table)));
}

}  // namespace lightstripe
